// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "palpate/material/law_list.h"

namespace palpate::test {

/// Whether the law's stress or tangent may jump close to F, where no finite difference can be
/// trusted: fibres about to slacken, a rotation about to flip. False for a law that says nothing.
template <class Law>
bool nearKink(const Law&, const Mat3&) {
  return false;
}

/// E = I4bar - 1 at E = 0, for a structure tensor M with tr M = 1.
inline bool nearlySlack(const Mat3& F, const Mat3& M) {
  const double J = F.determinant();
  return std::abs((F.transpose() * F).cwiseProduct(M).sum() / std::cbrt(J * J) - 1.0) < 0.02;
}

inline bool nearKink(const material::HolzapfelOgden&, const Mat3& F) {
  return nearlySlack(F, Vec3(1.0, 0.0, 0.0).asDiagonal()) ||
         nearlySlack(F, Vec3(0.0, 1.0, 0.0).asDiagonal());
}

/// The families of its example().
inline bool nearKink(const material::HolzapfelGasserOgden&, const Mat3& F) {
  const material::Constants constants = material::HolzapfelGasserOgden::example();
  for (std::size_t i = 0; i < constants.at("angle").size(); ++i) {
    const double angle = constants.at("angle")[i], d = constants.at("dispersion")[i];
    const Vec3 a(std::cos(angle), std::sin(angle), 0.0);
    if (nearlySlack(F, d * Mat3::Identity() + (1.0 - 3.0 * d) * a * a.transpose())) return true;
  }
  return false;
}

inline bool nearKink(const material::Corotational&, const Mat3& F) {
  const Vec3 s = material::principalStretches(F).s;
  return s(1) + s(2) < 0.1;
}

}  // namespace palpate::test
