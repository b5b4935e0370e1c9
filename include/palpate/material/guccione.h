// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/isochoric.h"
#include "palpate/material/own_constants.h"

namespace palpate::material {

/// Guccione's transversely isotropic solid, of the myocardium [Guccione, McCulloch, Waldman 1991],
/// in the form of Land et al. 2015, with the fibre along x of the material frame:
///
///   psi = c/2 (exp(Q) - 1) + kappa/2 (J - 1)^2,   E = (Fbar^T Fbar - I)/2
///   Q = bf E11^2 + bt (E22^2 + E33^2 + 2 E23^2) + bfs (2 E12^2 + 2 E13^2)
///
/// E is the isochoric Green strain, Fbar = J^(-1/3) F, so the exponential is volume-free; in the
/// papers' incompressible bodies it is the whole strain. Shear moduli at rest: c bt/2 across the
/// fibres, as in moduli(), and c bfs/2 along the fibres.
class Guccione : public IsochoricLaw<Guccione> {
 public:
  static constexpr bool kNeedsFibres = true;
  static constexpr std::string_view kName = "guccione";
  static std::vector<std::string> constantNames() {
    return withBulkModulus({"c", "bf", "bt", "bfs"});
  }
  static Constants example() {
    return {{"c", {2000.0}}, {"bf", {8.0}}, {"bt", {2.0}}, {"bfs", {4.0}}, {"kappa", {1.0e4}}};
  }

  /// c [Pa], bf, bt, bfs; kappa [Pa] or poisson_ratio.
  /// @throws std::invalid_argument, see OwnConstants; c, bf, bt or bfs not > 0.
  explicit Guccione(const Constants& constants) {
    const OwnConstants own(constants, {"c", "bf", "bt", "bfs"});
    c_ = own.positive("c");
    const double f = own.positive("bf"), t = own.positive("bt"), fs = own.positive("bfs");
    b_ << f, fs, fs, fs, t, t, fs, t, t;
    kappa_ = own.bulkModulus(0.5 * c_ * t);
  }

  /// Moduli at rest, shear across the fibres.
  Moduli moduli() const { return {0.5 * c_ * b_(1, 1), kappa_}; }

  /// Energy with Q = E : (b o E), o the elementwise product.
  double isochoricEnergy(const Mat3& F) const { return 0.5 * c_ * std::expm1(exponent(F)); }

  /// F S, S = c exp(Q) b o E [Pa].
  Mat3 isochoricStress(const Mat3& F) const {
    return c_ * std::exp(exponent(F)) * F * b_.cwiseProduct(greenStrain(F));
  }

  /// Geometric part S_jl delta_ik plus F dS [Pa].
  Mat9 isochoricTangent(const Mat3& F) const {
    const double e = c_ * std::exp(exponent(F));
    const Mat3 bE = b_.cwiseProduct(greenStrain(F));
    const Mat3 FbE = F * bE;
    Mat9 K = 2.0 * e * vec(FbE) * vec(FbE).transpose();
    for (int j = 0; j < 3; ++j) {
      for (int l = 0; l < 3; ++l) {
        auto K_jl = K.block<3, 3>(3 * j, 3 * l);
        K_jl.diagonal().array() += e * bE(j, l);
        K_jl += 0.5 * e * b_(l, j) * F.col(l) * F.col(j).transpose();
        if (j == l) K_jl += 0.5 * e * F * b_.col(j).asDiagonal() * F.transpose();
      }
    }
    return K;
  }

 private:
  static Mat3 greenStrain(const Mat3& F) { return 0.5 * (F.transpose() * F - Mat3::Identity()); }
  double exponent(const Mat3& F) const {
    const Mat3 E = greenStrain(F);
    return E.cwiseProduct(b_).cwiseProduct(E).sum();
  }

  double c_;      // [Pa]
  Mat3 b_;        // factor of each strain component
  double kappa_;  // [Pa]
};

}  // namespace palpate::material
