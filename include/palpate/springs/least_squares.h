// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace palpate::springs {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// x with the least |A x - b|^2 among those with C x = 0, nearest to 0 where there are several.
/// Rows of C may depend on each other. By the proximal method of multipliers [Rockafellar 1976]:
/// each step solves one quasi-definite system [Vanderbei 1995], factorised once.
Eigen::VectorXd equalityLeastSquares(const SparseMatrix& A, const Eigen::VectorXd& b,
                                     const SparseMatrix& C);

/// What boundedLeastSquares() found.
struct BoundedSolution {
  Eigen::VectorXd x;
  int factorisations = 0;
  /// How far any unknown would go down the slope within its bounds, over |b|, A's columns scaled to
  /// length 1; 0 at the optimum.
  double worst_gradient = 0.0;
};

/// x with the least |A x - b|^2 and 0 <= x <= upper (infinite: no bound), by projected Newton steps
/// [Bertsekas 1982]: every step factorises the part of those that no bound holds, and makes the
/// squares less. A's columns may depend on each other; then unknowns that A does not determine stay
/// near 0. Ends at a worst_gradient of 1e-10, or where only rounding is left.
///
/// @throws std::runtime_error if worst_gradient is above 1e-7 after 500 factorisations.
BoundedSolution boundedLeastSquares(const SparseMatrix& A, const Eigen::VectorXd& b,
                                    const Eigen::VectorXd& upper);

}  // namespace palpate::springs
