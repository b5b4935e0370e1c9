// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "rest_shape.h"

namespace palpate::fem {

/// Adds the upper blocks K_ab = V (d2psi/dF2 : g_a (x) g_b) of the 9 x 9 tangent at an integration
/// point, row after row.
template <int N>
void addElementBlocks(const Mat9& tangent, const RestPoint<N>& point, double* out) {
  const Eigen::Matrix<double, 3, N>& g = point.gradients;
  Eigen::Matrix<double, 9, 3 * N> CB;  // columns 3 b + c: tangent (e_c (x) g_b)
  for (int b = 0; b < N; ++b) {
    CB.template middleCols<3>(3 * b) =
        (point.volume * g(0, b)) * tangent.template middleCols<3>(0) +
        (point.volume * g(1, b)) * tangent.template middleCols<3>(3) +
        (point.volume * g(2, b)) * tangent.template middleCols<3>(6);
  }
  for (int a = 0; a < N; ++a) {
    for (int b = a; b < N; ++b, out += 9) {
      Eigen::Map<Mat3>{out} += g(0, a) * CB.template block<3, 3>(0, 3 * b) +
                               g(1, a) * CB.template block<3, 3>(3, 3 * b) +
                               g(2, a) * CB.template block<3, 3>(6, 3 * b);
    }
  }
}

}  // namespace palpate::fem
