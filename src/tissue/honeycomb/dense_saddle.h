// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace palpate::tissue {

/// n unknowns y with a symmetric positive definite stiffness H and m conditions C y, dense:
///
///   H y - C^T p = -g,   C y = -v
///
/// by Cholesky's factors of H and of C H^-1 C^T [Benzi, Golub, Liesen 2005, sec. 5]. Allocates
/// nothing but where it is larger than ever before.
class DenseSaddle {
 public:
  /// All zero.
  void reset(int n, int m);
  /// Of the lower triangle, b <= a.
  double& stiffness(int a, int b) { return H_[at(a, b)]; }
  double& condition(int c, int a) { return C_[at(c, a)]; }

  /// Conditions that contradict each other give way by 1e-10. False: H is not positive definite.
  bool factor();
  /// Afterwards. Sizes: g, y n; v, p m. Returns -y H y.
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
