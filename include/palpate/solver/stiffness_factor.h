// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// Sparse Cholesky factor of one stiffness, kept for many right sides.
class StiffnessFactor {
 public:
  /// @throws std::runtime_error if `A` is not positive definite or not finite.
  explicit StiffnessFactor(const fem::Stiffness& A);
  ~StiffnessFactor();

  /// A X = B, each column the 3 n components of a nodal field, node after node.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::solver
