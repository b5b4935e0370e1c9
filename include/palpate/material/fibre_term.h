// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "palpate/material/tensor.h"

namespace palpate::material {

/// Energy of fibres, an exponential of one strain measure E:
///
///   W = k/(2 b) (exp(b E^2) - 1),   E = (C - I) : M,   C = F^T F
///
/// M is symmetric, dimensionless, in the material frame. M = a a^T gives E = I4 - 1, the squared
/// stretch along the fibre a less one. M = (a b^T + b a^T)/2 gives E = I8, the shear between a and
/// b.
///
/// A term with tension only is zero for E <= 0. Its stress is continuous there; its tangent jumps
/// by k at E = 0, where it is zero.
struct FibreTerm {
  double k;  ///< [Pa], >= 0.
  double b;  ///< > 0.
  Mat3 M;
  bool tension_only;

  /// E; exactly zero at rest.
  double strain(const Mat3& F) const {
    return (F.transpose() * F - Mat3::Identity()).cwiseProduct(M).sum();
  }

  double energy(const Mat3& F) const {
    const double E = strain(F);
    return isSlack(E) ? 0.0 : 0.5 * k / b * std::expm1(b * E * E);
  }

  /// *P += dW/dF = 2 k E exp(b E^2) F M [Pa].
  void addStress(const Mat3& F, Mat3* P) const {
    const double E = strain(F);
    if (!isSlack(E)) *P += 2.0 * k * E * std::exp(b * E * E) * F * M;
  }

  /// *K += d2W/d vec F^2 [Pa].
  void addTangent(const Mat3& F, Mat9* K) const {
    const double E = strain(F);
    if (isSlack(E)) return;
    const double e = std::exp(b * E * E);
    const Mat3 gradient = 2.0 * F * M;
    *K += k * (1.0 + 2.0 * b * E * E) * e * vec(gradient) * vec(gradient).transpose();
    for (int j = 0; j < 3; ++j) {
      for (int l = 0; l < 3; ++l) {
        K->block<3, 3>(3 * j, 3 * l).diagonal().array() += 2.0 * k * E * e * M(j, l);
      }
    }
  }

 private:
  bool isSlack(double E) const { return k == 0.0 || (tension_only && E <= 0.0); }
};

}  // namespace palpate::material
