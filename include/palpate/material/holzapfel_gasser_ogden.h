// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/fibre_term.h"
#include "palpate/material/invariants.h"
#include "palpate/material/own_constants.h"

namespace palpate::material {

/// Holzapfel-Gasser-Ogden solid, of artery walls: a neo-Hookean matrix and families of dispersed
/// fibres that resist tension only [Gasser, Ogden, Holzapfel 2006], isochoric-volumetric:
///
///   psi = mu/2 (I1bar - 3) + sum_i k1_i/(2 k2_i) (exp(k2_i E_i^2) - 1) + kappa/2 (J - 1)^2
///   E_i = d_i (I1bar - 3) + (1 - 3 d_i) (I4bar_i - 1), a family counting where E_i > 0
///
/// I4bar_i is the squared isochoric stretch along family i, in the x-y plane of the material frame,
/// at `angle` from x (the fibre) towards y (the sheet). The dispersion d_i is 0 for parallel and
/// 1/3 for isotropic fibres; a family acts for E_i > 0. Each family has one entry in each list.
class HolzapfelGasserOgden : public IsochoricLaw<HolzapfelGasserOgden> {
 public:
  static constexpr bool kNeedsFibres = true;
  static constexpr std::string_view kName = "holzapfel_gasser_ogden";
  static std::vector<std::string> constantNames() {
    return withBulkModulus({"mu", "k1", "k2", "dispersion", "angle"});
  }
  static Constants example() {
    return {{"mu", {2.0e3}},        {"k1", {3.0e3, 2.0e3}},
            {"k2", {0.8, 1.2}},     {"dispersion", {0.0, 0.2}},
            {"angle", {0.7, -0.5}}, {"kappa", {1.0e4}}};
  }

  /// mu [Pa]; lists k1 [Pa], k2, dispersion, angle [rad]; kappa [Pa] or poisson_ratio.
  /// @throws std::invalid_argument, see OwnConstants; mu or a k2 not > 0; a k1 < 0; a dispersion
  /// not in [0, 1/3]; lists of unequal length.
  explicit HolzapfelGasserOgden(const Constants& constants) {
    const OwnConstants own(constants, {"mu", "k1", "k2", "dispersion", "angle"});
    mu_ = own.positive("mu");
    const auto lists = own.listsOfEqualLength({"k1", "k2", "dispersion", "angle"});
    for (std::size_t i = 0; i < lists[0].size(); ++i) {
      families_.push_back(family(lists[0][i], lists[1][i], lists[2][i], lists[3][i]));
    }
    kappa_ = own.bulkModulus(mu_);
  }

  /// Moduli of the matrix at rest; stretched fibres add to them.
  Moduli moduli() const { return {mu_, kappa_}; }

  double isochoricEnergy(const Mat3& F) const {
    double W = 0.5 * mu_ * (F.squaredNorm() - 3.0);
    for (const FibreTerm& term : families_) W += term.energy(F);
    return W;
  }

  Mat3 isochoricStress(const Mat3& F) const {
    Mat3 P = mu_ * F;
    for (const FibreTerm& term : families_) term.addStress(F, &P);
    return P;
  }

  Mat9 isochoricTangent(const Mat3& F) const {
    Mat9 K = mu_ * Mat9::Identity();
    for (const FibreTerm& term : families_) term.addTangent(F, &K);
    return K;
  }

 private:
  static FibreTerm family(double k1, double k2, double dispersion, double angle) {
    require(k1 >= 0.0, "k1", k1, ">= 0");
    require(k2 > 0.0, "k2", k2, "> 0");
    require(dispersion >= 0.0 && dispersion <= 1.0 / 3.0, "dispersion", dispersion, "in [0, 1/3]");
    const Vec3 a(std::cos(angle), std::sin(angle), 0.0);
    const Mat3 M = dispersion * Mat3::Identity() + (1.0 - 3.0 * dispersion) * a * a.transpose();
    return {k1, k2, M, true};
  }

  double mu_, kappa_;  // [Pa]
  std::vector<FibreTerm> families_;
};

}  // namespace palpate::material
