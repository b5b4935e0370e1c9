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
  /// Largest violation of the conditions of optimality, A's columns scaled to length 1: of the
  /// gradient of a free unknown, or of one that a bound does not hold, over |b|.
  double worst_gradient = 0.0;
};

/// x with the least |A x - b|^2 and 0 <= x <= upper (infinite: no bound), by block principal
/// pivoting [Portugal, Judice, Vicente 1994], and where that makes no progress, because A's columns
/// depend on each other, by an active set that descends. The set of bounds that hold is exact, not
/// the limit of an iteration. A ridge of 1e-7 of each column's square, refined away, keeps unknowns
/// that A does not determine small.
///
/// @throws std::runtime_error if no such set is found within 5000 factorisations.
BoundedSolution boundedLeastSquares(const SparseMatrix& A, const Eigen::VectorXd& b,
                                    const Eigen::VectorXd& upper);

}  // namespace palpate::springs
