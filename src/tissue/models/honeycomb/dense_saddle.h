// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace palpate::tissue {

/// Dense saddle-point system of n unknowns y with symmetric positive definite H and m constraints:
///
///   H y - C^T p = -g,   C y = -v
///
/// by Cholesky factors of H and C H^-1 C^T [Benzi, Golub, Liesen 2005, sec. 5]. Allocates only to
/// grow its buffers.
class DenseSaddle {
 public:
  /// Resizes, with zero values.
  void reset(int n, int m);
  /// Element of the lower triangle, b <= a.
  double& stiffness(int a, int b) { return H_[at(a, b)]; }
  double& condition(int c, int a) { return C_[at(c, a)]; }

  /// Factorises, with a regularisation of 1e-10 for dependent constraints. Returns false where H is
  /// not positive definite.
  bool factor();
  /// Solves; sizes: g, y: n; v, p: m. Returns -y H y.
  /// @pre A successful factorisation.
  double solve(const std::vector<double>& g, const std::vector<double>& v, std::vector<double>* y,
               std::vector<double>* p);

 private:
  std::size_t at(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(n_) +
           static_cast<std::size_t>(column);
  }
  int n_ = 0, m_ = 0;
  std::vector<double> H_, S_, C_, row_;  // row by row
};

}  // namespace palpate::tissue
