// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/material/material.h"
#include "support/law_response.h"

namespace palpate::test {

/// Nominal stress [Pa] along z of a bar stretched by `lambda` there with free sides: the transverse
/// stretch makes the law's own stress vanish, found by bisection.
inline double uniaxialStress(const material::Material& law, double lambda, double* transverse) {
  const auto stress = [&](double t) {
    const Mat3 F = Vec3(t, t, lambda).asDiagonal();
    return firstPiolaKirchhoff(law, F);
  };
  double low = 0.5, high = 1.5;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (stress(middle)(0, 0) < 0.0 ? low : high) = middle;
  }
  *transverse = 0.5 * (low + high);
  return stress(*transverse)(2, 2);
}

}  // namespace palpate::test
