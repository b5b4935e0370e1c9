// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/response_settings.h"
#include "palpate/formats/trajectory.h"
#include "palpate/material/constants.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/step_settings.h"

namespace palpate::torture {

inline constexpr double kSheetThickness = 0.001;  ///< Of model cloth [m].

/// An organ of a random test scene, in the world frame.
struct TortureOrgan {
  std::string name;
  std::string shape;           ///< One of meshShapes(), or of organs::organNames().
  mesh::TetMesh mesh;          ///< Of the organ; empty: made from `surface`.
  mesh::SurfaceMesh surface;   ///< To be meshed; empty with `mesh`.
  double edge_length = 0.0;    ///< Of tetrahedra made from `surface` [m].
  Vec3 size = Vec3::Zero();    ///< Of the bounding box [m].
  Vec3 low = Vec3::Zero();     ///< Lower corner of the bounding box [m].
  double min_dihedral = 90.0;  ///< Of the mesh [degrees].

  std::string model = "fem", element = "anp", scheme = "implicit", law;
  material::Constants constants;
  double young = 0.0, poisson = 0.0;  ///< At small strains [Pa], [-].
  double density = 1000.0;            ///< [kg/m^3]
  double contrast = 1.0;              ///< Stiffness of the upper half over that of the lower half.
  double prony_g = 0.0, prony_tau = 1.0;
  double mass_damping = 0.0, stiffness_damping = 0.0;  ///< [1/s], [s]
  double adapt = 0.0;                                  ///< Finest edge of adaptation [m]; 0: none.
  bool held = true;                                    ///< Held from `low.z()` up to heldTo().

  /// Height up to which points are held [m].
  double heldTo() const;
  /// P-wave modulus at small strains of the stiffest part [Pa].
  double waveModulus() const;
};

/// A tool of one shape; its joints x, y, z, roll, pitch, yaw are its pose in the world.
struct TortureTool {
  std::string name;
  std::string shape;         ///< One of toolShapes().
  Vec3 size = Vec3::Zero();  ///< Radius, or half extents; last: half length [m].

  double radius() const { return size.norm(); }  ///< Of a bounding ball [m].
};

/// Initial state of a scene.
enum class Start { kRest, kRandom, kFlat, kInverted, kTwisted, kScaled, kTurnedGravity, kThrown };

const char* toString(Start start);

/// A random scene with the motion of its tools. writeScene() writes it as files that users can
/// replay.
struct TortureScene {
  std::uint64_t seed = 1;
  int number = 0;
  std::string category;  ///< One of categories().
  std::vector<TortureOrgan> organs;
  std::vector<TortureTool> tools;
  bool bone = false;            ///< A block below the organs.
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]
  double friction = 0.0;
  std::string contact = contact::ResponseSettings().model;  ///< Contact model.
  std::string method = solver::StepSettings().method;
  std::string integrator = solver::StepSettings().integrator;
  double step = solver::StepSettings().step;  ///< Largest time step [s].
  Start start = Start::kRest;
  double thrown = 0.0;  ///< Initial downward speed of the second organ [m/s].
  formats::Trajectory trajectory;
  std::size_t leave = 0;  ///< First row without a tool near the organs.
  bool rests = false;     ///< Whether damping and duration let everything come to rest.
  bool live = false;      ///< Whether cycles are cut at the deadline.

  double size() const;  ///< Diagonal of the bounding box of all organs [m].
};

/// Kinds of motion of tools or organs.
const std::vector<std::string>& categories();
const std::vector<std::string>& toolShapes();

/// The random scene `number` of a seed, equal on every machine.
TortureScene drawScene(std::uint64_t seed, int number);

/// A line of text: "tet4 neo_hookean E=... nu=..., 300 tetrahedra ...".
std::string describe(const TortureScene& scene);

}  // namespace palpate::torture
