// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/invariants.h"
#include "palpate/material/own_constants.h"

namespace palpate::material {

/// Veronda-Westmann solid for skin [Veronda, Westmann 1970], isochoric-volumetric:
///
///   psi = c1 (exp(alpha (I1bar - 3)) - 1) + c2 (I2bar - 3) + kappa/2 (J - 1)^2
///
/// c2 defaults to -c1 alpha/2 as in that paper. mu = 2 (c1 alpha + c2) at rest must be > 0; with
/// the default it is c1 alpha.
class VerondaWestmann : public InvariantLaw<VerondaWestmann> {
 public:
  static constexpr std::string_view kName = "veronda_westmann";
  static std::vector<std::string> constantNames() { return withBulkModulus({"c1", "alpha", "c2"}); }
  static Constants example() { return {{"c1", {800.0}}, {"alpha", {1.5}}, {"kappa", {1.0e4}}}; }

  /// c1 [Pa], alpha; optional c2 [Pa]; kappa [Pa] or poisson_ratio.
  /// @throws std::invalid_argument, see OwnConstants; c1, alpha or c1 alpha + c2 not > 0.
  explicit VerondaWestmann(const Constants& constants) {
    const OwnConstants own(constants, {"c1", "alpha"});
    c1_ = own.positive("c1");
    alpha_ = own.positive("alpha");
    c2_ = own.numberOr("c2", -0.5 * c1_ * alpha_);
    const double half_mu = c1_ * alpha_ + c2_;
    require(half_mu > 0.0, "c1 alpha + c2", half_mu, "> 0, or the body is unstable at rest");
    kappa_ = own.bulkModulus(2.0 * half_mu);
  }

  Moduli moduli() const { return {2.0 * (c1_ * alpha_ + c2_), kappa_}; }

  double energy(double x1, double x2) const { return c1_ * std::expm1(alpha_ * x1) + c2_ * x2; }
  InvariantDerivatives derivatives(double x1, double) const {
    const double w1 = c1_ * alpha_ * std::exp(alpha_ * x1);
    return {w1, c2_, alpha_ * w1};
  }

 private:
  double c1_, c2_, kappa_;  // [Pa]
  double alpha_;
};

}  // namespace palpate::material
