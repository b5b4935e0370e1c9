// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/fem/elasticity.h"
#include "palpate/keys/fields.h"
#include "palpate/mesh/selection.h"
#include "palpate/scene/body_config.h"
#include "palpate/solver/integrator.h"
#include "palpate/solver/static_solver.h"
#include "palpate/solver/step_settings.h"

namespace palpate::analysis {

// The case file of `palpate solve` as plain data. Defaults are member initialisers of these structs
// or of settings that they contain. case_fields.cpp lists every key once, with unit, range and
// meaning.

struct BoxMesh {
  Vec3 size = Vec3::Ones();                         ///< [m], from the origin.
  Eigen::Vector3i cells = Eigen::Vector3i::Ones();  ///< Per axis.
};

/// Exactly one of `file` and `box`.
struct CaseMesh {
  std::string file;  ///< Relative to the case's folder.
  std::optional<BoxMesh> box;
  double scale = 1.0;  ///< Unit of file or box [m].
};

/// Rotation by `angle` about the line through `origin` along `axis`.
struct Rotation {
  Vec3 axis = Vec3::UnitZ();   ///< Of any nonzero length.
  Vec3 origin = Vec3::Zero();  ///< [m]
  double angle = 0.0;          ///< [rad]
};

/// Conditions at the selected nodes. Displacements: x = R (X - o) + o + d, with missing components
/// of d free; a rotation without displacement means d = 0. Tractions and pressures act on boundary
/// faces with all corners selected.
struct BoundaryCondition {
  mesh::Region select;
  std::optional<keys::PartialVec3> displacement;  ///< [m]
  std::optional<Rotation> rotation;
  std::optional<Vec3> traction;    ///< [Pa], dead load on the reference area.
  std::optional<double> pressure;  ///< [Pa], follower; positive pushes inward.

  bool holds() const { return displacement || rotation; }
};

struct StaticAnalysis : solver::StaticSettings {};

struct DynamicAnalysis {
  std::string integrator = solver::StepSettings().integrator;
  std::string method = solver::StepSettings().method;
  double dt = solver::StepSettings().step;  ///< [s]
  double duration = 0.0;                    ///< [s]
  std::optional<double> ramp_time;  ///< Time in which conditions grow [s]; default: duration.
  solver::RayleighDamping damping;
  double tolerance = solver::StepSettings().tolerance;
  int max_newton_iterations = solver::StepSettings().max_newton_iterations;
  double linear_tolerance = solver::StepSettings().linear_tolerance;
  int max_linear_iterations = solver::StepSettings().max_linear_iterations;
};

/// Displacement and stress at a point, or a sum over a region.
struct Probe {
  std::string name;
  std::optional<Vec3> point;           ///< [m], in the rest configuration.
  std::optional<mesh::Region> select;  ///< With `quantity`.
  std::string quantity;                ///< "reaction": force and moment about the origin of the
                                       ///< support on the body.
};

/// The body's frame is the mesh file's, after scaling.
struct Case : scene::BodyConfig {
  std::string file;  ///< Path of the case file.
  CaseMesh mesh;
  std::string element = fem::elementNames().front();
  std::vector<BoundaryCondition> boundary;
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]
  std::variant<StaticAnalysis, DynamicAnalysis> analysis;
  std::vector<Probe> probes;
};

/// Allowed values of Probe::quantity.
std::vector<std::string> quantityNames();

/// Reads and checks a case file, but not the mesh that it names.
/// @throws InputError with all problems of the file.
Case readCase(const std::string& file);

/// Text of docs/case_format.md, from the keys.
std::string caseFormatMarkdown();

}  // namespace palpate::analysis
