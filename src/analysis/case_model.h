// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/analysis/case.h"
#include "palpate/fem/composition.h"
#include "palpate/fem/loads.h"
#include "palpate/solver/potential.h"

namespace palpate::analysis {

/// A case in the form that solvers take.
class CaseModel {
 public:
  /// @throws InputError
  CaseModel(const Case& problem, ThreadPool* pool);

  const mesh::TetMesh& mesh() const { return mesh_; }
  const fem::Composition& composition() const { return composition_; }
  const std::shared_ptr<fem::Elasticity>& elasticity() const { return elasticity_; }
  /// Elastic energy with tractions, pressures and gravity.
  const solver::Potential& potential() const { return potential_; }

  void setLoadFactor(double s);
  /// Positions of held components at the fraction `s` of their motion, 3 x n [m].
  Points heldPositions(double s) const;
  /// Sum of the norms of all applied forces, the scale of a residual [N].
  double loadNorm() const;

 private:
  struct HeldNodes {
    std::vector<int> nodes;
    BoundaryCondition condition;
  };
  void addCondition(const BoundaryCondition& condition, const std::string& key,
                    const std::string& file);

  mesh::TetMesh mesh_;
  Eigen::MatrixXi surface_;
  fem::Composition composition_;
  std::shared_ptr<fem::Elasticity> elasticity_;
  std::vector<HeldNodes> held_;
  std::vector<std::unique_ptr<fem::DeadLoad>> dead_loads_;
  std::vector<std::unique_ptr<fem::FollowerPressure>> pressures_;
  solver::Potential potential_;
};

}  // namespace palpate::analysis
