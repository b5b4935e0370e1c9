// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/fem/composition.h"
#include "palpate/fem/elasticity.h"
#include "palpate/fem/loads.h"
#include "palpate/fem/supports.h"
#include "palpate/mesh/surface_points.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/potential.h"
#include "palpate/solver/static_solver.h"

namespace palpate::enrichment {

/// A force on a patch of a surface.
struct Press {
  Vec3 contact;  ///< Centre of the patch [m].
  Vec3 force;    ///< [N]
};

/// A supported finite element body for presses from rest. The force acts on boundary nodes within
/// `patch` [m] of the contact, in proportion to their area times 1 - (distance/patch)^2, or on the
/// nearest alone.
class PressedBody {
 public:
  /// `mesh`: at rest [m]; `surface`: points whose displacements are wanted, at the nearest points
  /// of the mesh's boundary. `pool` may be null.
  /// @throws std::invalid_argument for free rigid motions, and as fem::makeElasticity().
  PressedBody(const std::string& element, mesh::TetMesh mesh, const fem::Composition& composition,
              const fem::FreeMask& free, const Points& surface, double patch, ThreadPool* pool);
  PressedBody(const PressedBody&) = delete;
  PressedBody& operator=(const PressedBody&) = delete;

  /// Displacements of the surface's points under a press, 3 x n [m]; after a failed solve those of
  /// the last solved load step.
  solver::StaticReport press(const Press& press, const solver::StaticSettings& settings,
                             Points* displacements);

  const mesh::TetMesh& mesh() const { return mesh_; }

 private:
  mesh::TetMesh mesh_;
  mesh::SurfaceMesh boundary_;
  Eigen::VectorXd areas_;  // of boundary nodes [m^2]
  std::vector<mesh::SurfacePoint> places_;
  double patch_;
  std::unique_ptr<fem::Elasticity> elasticity_;
  fem::DeadLoad load_;
  solver::Potential potential_;
};

}  // namespace palpate::enrichment
