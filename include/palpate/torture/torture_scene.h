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

/// An organ of a scene of torture, in the world.
struct TortureOrgan {
  std::string name;
  std::string shape;           ///< One of meshShapes(), or an organ of organs::organNames().
  mesh::TetMesh mesh;          ///< Or, where this is empty,
  mesh::SurfaceMesh surface;   ///< what is filled in edges of
  double edge_length = 0.0;    ///< [m].
  Vec3 size = Vec3::Zero();    ///< Of its box, which begins at
  Vec3 low = Vec3::Zero();     ///< [m].
  double min_dihedral = 90.0;  ///< Of the mesh [degrees].

  std::string model = "fem", element = "anp", scheme = "implicit", law;
  material::Constants constants;
  double young = 0.0, poisson = 0.0;  ///< Of small strains [Pa], [-].
  double density = 1000.0;            ///< [kg/m^3]
  double contrast = 1.0;              ///< So many times as stiff is its upper half.
  double prony_g = 0.0, prony_tau = 1.0;
  double mass_damping = 0.0, stiffness_damping = 0.0;  ///< [1/s], [s]
  double adapt = 0.0;                                  ///< Finest edge of a mesh that adapts [m].
  bool held = true;                                    ///< At `low.z()` up to heldTo().

  /// Points up to here are held [m].
  double heldTo() const;
  /// Of small strains without contraction to the sides, of its stiffest part [Pa].
  double waveModulus() const;
};

/// A tool of one shape, whose joints x, y, z, roll, pitch, yaw are its pose in the world.
struct TortureTool {
  std::string name;
  std::string shape;         ///< One of toolShapes().
  Vec3 size = Vec3::Zero();  ///< Radius, or half extents; the last is half the length [m].

  double radius() const { return size.norm(); }  ///< Around all of it [m].
};

/// How a scene begins.
enum class Start { kRest, kRandom, kFlat, kInverted, kTwisted, kScaled, kTurnedGravity, kThrown };

const char* toString(Start start);

/// A scene that is drawn, and how the tools go. Everything stands in files that a user can read and
/// replay: see writeScene().
struct TortureScene {
  std::uint64_t seed = 1;
  int number = 0;
  std::string category;  ///< One of categories().
  std::vector<TortureOrgan> organs;
  std::vector<TortureTool> tools;
  bool bone = false;            ///< A block below.
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]
  double friction = 0.0;
  std::string contact = contact::ResponseSettings().model;  ///< What answers where tissue touches.
  std::string method = solver::StepSettings().method;
  std::string integrator = solver::StepSettings().integrator;
  double step = solver::StepSettings().step;  ///< Longest [s].
  Start start = Start::kRest;
  double thrown = 0.0;  ///< The second organ's speed, down [m/s].
  formats::Trajectory trajectory;
  std::size_t leave = 0;  ///< From this row on no tool is near.
  bool rests = false;     ///< Damped, and so long that all must be at rest in the end.
  bool live = false;      ///< Cycles are ended at the deadline.

  double size() const;  ///< Diagonal of the box around all organs [m].
};

/// What the tools, or the organs, do.
const std::vector<std::string>& categories();
const std::vector<std::string>& toolShapes();

/// The scene `number` of the seed, on any machine.
TortureScene drawScene(std::uint64_t seed, int number);

/// "tet4 neo_hookean E=... nu=..., 300 tetrahedra ...": in a line.
std::string describe(const TortureScene& scene);

}  // namespace palpate::torture
