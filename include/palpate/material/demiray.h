// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/invariants.h"
#include "palpate/material/own_constants.h"

namespace palpate::material {

/// W = a/(2 b) (exp(b x) - 1), x = I1 - 3: Demiray's solid, and the matrix of holzapfel_ogden.
struct FirstInvariantExponential {
  double a;  ///< Shear modulus at rest [Pa].
  double b;

  double energy(double x) const { return 0.5 * a / b * std::expm1(b * x); }
  InvariantDerivatives derivatives(double x) const {
    InvariantDerivatives d;
    d.w1 = 0.5 * a * std::exp(b * x);
    d.w11 = b * d.w1;
    return d;
  }
};

/// Demiray's solid [Demiray 1972], isochoric-volumetric:
///
///   psi = a/(2 b) (exp(b (I1bar - 3)) - 1) + kappa/2 (J - 1)^2
///
/// mu = a at rest; neo-Hookean in the limit of small b.
class Demiray : public InvariantLaw<Demiray> {
 public:
  static constexpr std::string_view kName = "demiray";
  static std::vector<std::string> constantNames() { return withBulkModulus({"a", "b"}); }
  static Constants example() { return {{"a", {2.0e3}}, {"b", {1.5}}, {"kappa", {1.0e4}}}; }

  /// a [Pa], b; kappa [Pa] or poisson_ratio.
  /// @throws std::invalid_argument, see OwnConstants; a or b not > 0.
  explicit Demiray(const Constants& constants) {
    const OwnConstants own(constants, {"a", "b"});
    matrix_ = {own.positive("a"), own.positive("b")};
    kappa_ = own.bulkModulus(matrix_.a);
  }

  Moduli moduli() const { return {matrix_.a, kappa_}; }

  double energy(double x, double) const { return matrix_.energy(x); }
  InvariantDerivatives derivatives(double x, double) const { return matrix_.derivatives(x); }

 private:
  FirstInvariantExponential matrix_;
  double kappa_;  // [Pa]
};

}  // namespace palpate::material
