// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace palpate::tissue {

/// Replaces the lower triangle of a symmetric n x n matrix, row by row, by its Cholesky factor.
/// False where it is not positive definite. Allocates nothing, whatever n.
inline bool factorize(int n, std::vector<double>* A) {
  const auto row = [&](int i) { return A->data() + static_cast<std::ptrdiff_t>(i) * n; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double left = row(i)[j] - Eigen::Map<const Eigen::VectorXd>(row(i), j).dot(
                                          Eigen::Map<const Eigen::VectorXd>(row(j), j));
      if (j < i) {
        row(i)[j] = left / row(j)[j];
      } else if (left > 0.0) {
        row(i)[i] = std::sqrt(left);
      } else {
        return false;
      }
    }
  }
  return true;
}

/// b := A^-1 b by the factor.
inline void solveFactorized(int n, const std::vector<double>& L, double* b) {
  const auto at = [&](int i, int j) {
    return L[static_cast<std::size_t>(i) * static_cast<std::size_t>(n) +
             static_cast<std::size_t>(j)];
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) b[i] -= at(i, j) * b[j];
    b[i] /= at(i, i);
  }
  for (int i = n - 1; i >= 0; --i) {
    b[i] /= at(i, i);
    for (int j = 0; j < i; ++j) b[j] -= at(i, j) * b[i];
  }
}

}  // namespace palpate::tissue
