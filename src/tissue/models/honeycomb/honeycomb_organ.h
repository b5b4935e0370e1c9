// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cell_solver.h"
#include "palpate/tissue/model_settings.h"
#include "palpate/tissue/tissue_model.h"
#include "tissue/touch/rest.h"
#include "tissue/touch/tool_contact.h"

namespace palpate::tissue {

/// Parts of an organ of model honeycomb.
struct HoneycombParts {
  CellLattice lattice;
  Eigen::Matrix3Xd free;              ///< Free components of the corners in O, 3 x n.
  Pose X_WO;                          ///< Pose of the lattice's frame.
  std::vector<double> shear_modulus;  ///< Of each cell [Pa].
  std::vector<double> density;        ///< Of each cell [kg/m^3].
};

/// A quasi-static organ of cells: each cycle ends in equilibrium; velocities are differences.
///
/// TissueStep: newton_iterations: waves; linear_iterations: solved cells; min_jacobian: least ratio
/// of volume or edge to rest. Residual and cut-off contribute to the imbalance.
class HoneycombOrgan final : public TissueModel {
 public:
  /// @throws std::runtime_error where there is no equilibrium under gravity.
  HoneycombOrgan(HoneycombParts parts, const HoneycombSettings& settings,
                 const ModelSettings& scene);

  SurfaceState surfaceState(int) const override { return {x_, v_, parts_.lattice.triangles, 0}; }
  mesh::CellMesh cells(int organ) const override;
  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override;
  std::vector<std::string> notes() const override;
  void setInterrupt(const solver::Interrupt* interrupt) override { interrupt_ = interrupt; }
  void reset() override;
  void setPositions(int organ, const Points& positions, const Points& velocities) override;
  State state() const override;
  void restore(const State& state) override;

  const CellState& cellState() const { return state_; }
  const CellBalance& balance() const { return balance_; }

 private:
  std::string kind() const;
  void findEquilibrium();
  void solveStages();
  bool isPierced();
  void add(const CellSolve& solve);
  void reportForces();

  HoneycombParts parts_;
  HoneycombSettings settings_;
  HeldSides held_;
  CellFabric fabric_;
  Points weight_;  // of each cell in O [N]
  CellBalance balance_;
  CornerMap map_;
  ToolContact tool_contact_;
  Rest rest_;
  double tolerance_;  // [N]
  CellSolver solver_;
  const solver::Interrupt* interrupt_ = nullptr;
  CellState equilibrium_, state_, begin_state_;
  std::vector<double> begin_memory_;  // of the waves
  Points x_, v_, x_begin_, f_;
  std::vector<contact::Contact> contacts_;  // scratch
  TissueStep out_;
};

}  // namespace palpate::tissue
