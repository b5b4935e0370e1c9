// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/invariants.h"
#include "palpate/material/own_constants.h"

namespace palpate::material {

/// Mooney-Rivlin solid with two constants [Mooney 1940, Rivlin 1948], isochoric-volumetric:
///
///   psi = c10 (I1bar - 3) + c01 (I2bar - 3) + kappa/2 (J - 1)^2
///
/// mu = 2 (c10 + c01) at rest, which must be > 0; one of the two may be negative.
class MooneyRivlin : public InvariantLaw<MooneyRivlin> {
 public:
  static constexpr std::string_view kName = "mooney_rivlin";
  static std::vector<std::string> constantNames() { return withBulkModulus({"c10", "c01"}); }
  static Constants example() { return {{"c10", {600.0}}, {"c01", {400.0}}, {"kappa", {1.0e4}}}; }

  /// c10, c01 [Pa]; kappa [Pa] or poisson_ratio.
  /// @throws std::invalid_argument, see OwnConstants; c10 + c01 not > 0.
  explicit MooneyRivlin(const Constants& constants) {
    const OwnConstants own(constants, {"c10", "c01"});
    c10_ = own.number("c10");
    c01_ = own.number("c01");
    require(c10_ + c01_ > 0.0, "c10 + c01", c10_ + c01_, "> 0, or the body is unstable at rest");
    kappa_ = own.bulkModulus(2.0 * (c10_ + c01_));
  }

  Moduli moduli() const { return {2.0 * (c10_ + c01_), kappa_}; }

  double energy(double x1, double x2) const { return c10_ * x1 + c01_ * x2; }
  InvariantDerivatives derivatives(double, double) const { return {c10_, c01_}; }

 private:
  double c10_, c01_, kappa_;  // [Pa]
};

}  // namespace palpate::material
