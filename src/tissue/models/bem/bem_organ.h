// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/bem/surface_stiffness.h"
#include "palpate/fem/supports.h"
#include "palpate/material/solid.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/tissue/model_settings.h"
#include "palpate/tissue/tissue_model.h"
#include "tissue/touch/compliant_contact.h"
#include "tissue/touch/rest.h"
#include "tissue/touch/tool_contact.h"

namespace palpate::tissue {

/// Parts of an organ of model bem.
struct BemParts {
  mesh::SurfaceMesh surface;  ///< Closed surface, outward, rest configuration, world [m].
  fem::FreeMask free;         ///< Free components of the points, 3 x n.
  material::Moduli moduli;    ///< Elastic moduli at rest.
  double density;             ///< [kg/m^3]
};

/// An organ as a surface with its compliance: linear elastostatics of the interior.
///
/// Quasi-static: no inertia, no damping, velocities are differences over a cycle; only contact has
/// state. Forces are linear, and large rotations are wrong. A cycle solves for contact forces and
/// superposes their displacements. Without elements TissueStep::min_jacobian is 1.
class BemOrgan final : public TissueModel {
 public:
  /// @throws std::invalid_argument as bem::surfaceStiffness() and bem::surfaceCompliance().
  BemOrgan(const BemParts& parts, const ModelSettings& settings, ThreadPool* pool);

  SurfaceState surfaceState(int) const override { return {x_, v_, surface_.triangles, 0}; }
  mesh::CellMesh cells(int organ) const override;
  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override;
  std::vector<std::string> notes() const override;
  void setInterrupt(const solver::Interrupt* interrupt) override { interrupt_ = interrupt; }
  void reset() override;
  void setPositions(int organ, const Points& positions, const Points& velocities) override;
  State state() const override;
  void restore(const State& state) override;

 private:
  std::string kind() const;
  double tolerance() const;
  void solveStages();
  solver::NewtonReport solveStage(double tolerance);
  void displace();
  void fail();
  void report();

  mesh::SurfaceMesh surface_;
  fem::FreeMask free_;
  ModelSettings settings_;
  bem::SurfaceStiffness stiffness_;
  Eigen::MatrixXd compliance_;
  Eigen::Matrix3Xd support_rows_;  // rows of the stiffness summed over held components, 3 x 3 n
  std::vector<int> places_;
  Points loads_, u_loads_;  // gravity [N], displacements under it [m]
  ToolContact tool_contact_;
  Rest rest_;
  CompliantContact contact_;
  const solver::Interrupt* interrupt_ = nullptr;
  double least_force_;                                // least force for tolerances [N]
  double contact_scale_ = 0.0, support_scale_ = 0.0;  // norms of nodal forces [N]
  Points force_;                                      // of contact on the nodes [N]
  Points x_, v_, x_begin_, force_begin_, g_;
  TissueStep out_;
};

}  // namespace palpate::tissue
