// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense_lu.h"

#include <utility>

namespace palpate::tissue {

void solveInPlace(Eigen::Map<Eigen::MatrixXd>& A, Eigen::Map<Eigen::VectorXd>& x) {
  const Eigen::Index n = A.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = 0;
    A.col(k).tail(n - k).cwiseAbs().maxCoeff(&pivot);
    if (pivot != 0) {
      A.row(k).swap(A.row(k + pivot));
      std::swap(x[k], x[k + pivot]);
    }
    auto below = A.col(k).tail(n - k - 1);
    below /= A(k, k);
    for (Eigen::Index j = k + 1; j < n; ++j) A.col(j).tail(n - k - 1) -= A(k, j) * below;
    x.tail(n - k - 1) -= x[k] * below;
  }
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    x[k] /= A(k, k);
    x.head(k) -= x[k] * A.col(k).head(k);
  }
}

}  // namespace palpate::tissue
