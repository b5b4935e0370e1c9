// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/isochoric.h"
#include "palpate/material/own_constants.h"
#include "palpate/material/principal_stretches.h"

namespace palpate::material {

/// Ogden's solid [Ogden 1972; Holzapfel 2000, section 6.5], isochoric-volumetric, with any number
/// of terms in the isochoric principal stretches l_i = J^(-1/3) s_i:
///
///   psi = sum_p mu_p/alpha_p (l_1^alpha_p + l_2^alpha_p + l_3^alpha_p - 3) + kappa/2 (J - 1)^2
///
/// 2 mu = sum_p mu_p alpha_p at rest. Each term must be stable alone: mu_p alpha_p > 0.
///
/// Another convention has 2 mu'_p/alpha_p^2 instead of mu_p/alpha_p, so that mu = sum_p mu'_p
/// (Abaqus, CalculiX, Budday et al. 2017). Conversion: mu_p = 2 mu'_p/alpha_p.
class Ogden : public IsochoricLaw<Ogden> {
 public:
  static constexpr std::string_view kName = "ogden";
  static std::vector<std::string> constantNames() { return withBulkModulus({"mu", "alpha"}); }
  static Constants example() {
    return {{"mu", {1500.0, -400.0}}, {"alpha", {2.2, -3.1}}, {"kappa", {1.0e4}}};
  }

  /// Lists mu [Pa] and alpha; kappa [Pa] or poisson_ratio.
  /// @throws std::invalid_argument, see OwnConstants; lists of unequal length; a product mu_p
  /// alpha_p not > 0.
  explicit Ogden(const Constants& constants) {
    const OwnConstants own(constants, {"mu", "alpha"});
    const auto lists = own.listsOfEqualLength({"mu", "alpha"});
    for (std::size_t p = 0; p < lists[0].size(); ++p) {
      const Term term{lists[0][p], lists[1][p]};
      const std::string place = "[" + std::to_string(p) + "]";
      require(term.mu * term.alpha > 0.0, "mu" + place + " alpha" + place, term.mu * term.alpha,
              "> 0, or the term is unstable at rest");
      terms_.push_back(term);
      moduli_.mu += 0.5 * term.mu * term.alpha;
    }
    moduli_.kappa = own.bulkModulus(moduli_.mu);
  }

  Moduli moduli() const { return moduli_; }

  double isochoricEnergy(const Mat3& F) const {
    const Vec3 s = principalStretches(F).s;
    double W = 0.0;
    for (const Term& term : terms_) {
      for (const double l : s) W += term.mu / term.alpha * std::expm1(term.alpha * std::log(l));
    }
    return W;
  }

  Mat3 isochoricStress(const Mat3& F) const {
    const PrincipalStretches p = principalStretches(F);
    const Vec3 slopes(slope(p.s(0)), slope(p.s(1)), slope(p.s(2)));
    return p.U * slopes.asDiagonal() * p.V.transpose();
  }

  /// Diagonal in the modes of PrincipalStretches, since W is a sum over the stretches.
  Mat9 isochoricTangent(const Mat3& F) const {
    const PrincipalStretches p = principalStretches(F);
    Mat9 modes;
    Vec9 curvatures;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double a = p.s(i), b = p.s(j);
      modes.col(i) = p.stretchMode(i);
      curvatures(i) = slopeDifference(a, a);
      modes.col(3 + i) = p.flipMode(i, j);
      curvatures(3 + i) = slopeDifference(a, b);
      modes.col(6 + i) = p.twistMode(i, j);
      curvatures(6 + i) = (slope(a) + slope(b)) / (a + b);
    }
    const Mat9 scaled = modes * curvatures.asDiagonal();
    const Mat9 K = scaled * modes.transpose();
    return 0.5 * (K + K.transpose());
  }

 private:
  struct Term {
    double mu;  // [Pa]
    double alpha;
  };

  // dW/dl [Pa].
  double slope(double l) const {
    double sum = 0.0;
    for (const Term& term : terms_) sum += term.mu * std::pow(l, term.alpha - 1.0);
    return sum;
  }

  // (slope(a) - slope(b))/(a - b), and its limit for a = b, without cancellation: with d = log a/b
  // and n = alpha - 1 each term is mu b^(n-1) (exp(n d) - 1)/(exp(d) - 1).
  double slopeDifference(double a, double b) const {
    const double d = std::log1p((a - b) / b);
    double sum = 0.0;
    for (const Term& term : terms_) {
      const double n = term.alpha - 1.0;
      const double ratio = d == 0.0 ? n : std::expm1(n * d) / std::expm1(d);
      sum += term.mu * std::pow(b, n - 1.0) * ratio;
    }
    return sum;
  }

  std::vector<Term> terms_;
  Moduli moduli_{0.0, 0.0};  // [Pa]
};

}  // namespace palpate::material
