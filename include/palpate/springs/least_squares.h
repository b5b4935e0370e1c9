// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace palpate::springs {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// x that minimises |A x - b|^2 subject to C x = 0, with the least norm if not unique. Rows of C
/// may be dependent. Proximal method of multipliers [Rockafellar 1976]: each step solves a
/// quasi-definite system [Vanderbei 1995], factorised once.
Eigen::VectorXd equalityLeastSquares(const SparseMatrix& A, const Eigen::VectorXd& b,
                                     const SparseMatrix& C);

/// Result of boundedLeastSquares().
struct BoundedSolution {
  Eigen::VectorXd x;
  int factorisations = 0;
  /// Largest projected gradient step of an unknown, over |b|, with A's columns scaled to length 1;
  /// 0 at the optimum.
  double worst_gradient = 0.0;
};

/// x that minimises |A x - b|^2 subject to 0 <= x <= upper (infinite: no bound), by projected
/// Newton steps [Bertsekas 1982]. Each step factorises the unbound part and reduces the squares.
/// A's columns may be dependent; undetermined unknowns stay near 0. Ends at a worst_gradient of
/// 1e-10, or where only rounding is left.
///
/// @throws std::runtime_error if worst_gradient is above 1e-7 after 500 factorisations.
BoundedSolution boundedLeastSquares(const SparseMatrix& A, const Eigen::VectorXd& b,
                                    const Eigen::VectorXd& upper);

}  // namespace palpate::springs
