// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/invariants.h"
#include "palpate/material/own_constants.h"

namespace palpate::material {

/// Yeoh solid [Yeoh 1993], a cubic in the first invariant, isochoric-volumetric:
///
///   psi = c1 x + c2 x^2 + c3 x^3 + kappa/2 (J - 1)^2,   x = I1bar - 3
///
/// mu = 2 c1 at rest. c2 and c3 may have any sign; if the last nonzero one is negative, the body
/// becomes unstable at large stretch.
class Yeoh : public InvariantLaw<Yeoh> {
 public:
  static constexpr std::string_view kName = "yeoh";
  static std::vector<std::string> constantNames() { return withBulkModulus({"c1", "c2", "c3"}); }
  static Constants example() {
    return {{"c1", {1.0e3}}, {"c2", {-200.0}}, {"c3", {300.0}}, {"kappa", {1.0e4}}};
  }

  /// c1, c2, c3 [Pa]; kappa [Pa] or poisson_ratio.
  /// @throws std::invalid_argument, see OwnConstants; c1 not > 0.
  explicit Yeoh(const Constants& constants) {
    const OwnConstants own(constants, {"c1", "c2", "c3"});
    c1_ = own.positive("c1");
    c2_ = own.number("c2");
    c3_ = own.number("c3");
    kappa_ = own.bulkModulus(2.0 * c1_);
  }

  Moduli moduli() const { return {2.0 * c1_, kappa_}; }

  double energy(double x, double) const { return x * (c1_ + x * (c2_ + x * c3_)); }
  InvariantDerivatives derivatives(double x, double) const {
    InvariantDerivatives d;
    d.w1 = c1_ + x * (2.0 * c2_ + x * 3.0 * c3_);
    d.w11 = 2.0 * c2_ + 6.0 * c3_ * x;
    return d;
  }

 private:
  double c1_, c2_, c3_, kappa_;  // [Pa]
};

}  // namespace palpate::material
