// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/demiray.h"
#include "palpate/material/fibre_term.h"

namespace palpate::material {

/// Holzapfel-Ogden solid, of the myocardium [Holzapfel, Ogden 2009, eq. 5.38], here
/// isochoric-volumetric, with the fibre f along x and the sheet s along y of the material frame:
///
///   psi = a/(2 b) (exp(b (I1bar - 3)) - 1)
///       + af/(2 bf) (exp(bf (I4f - 1)^2) - 1) + as/(2 bs) (exp(bs (I4s - 1)^2) - 1)
///       + afs/(2 bfs) (exp(bfs I8fs^2) - 1) + kappa/2 (J - 1)^2
///
/// I4f and I4s are the squared isochoric stretches along f and s, I8fs = f . Cbar s. The terms af
/// and as count in tension only. At rest afs adds to the shear modulus a in the f-s plane.
class HolzapfelOgden : public IsochoricLaw<HolzapfelOgden> {
 public:
  static constexpr bool kNeedsFibres = true;
  static constexpr std::string_view kName = "holzapfel_ogden";
  static std::vector<std::string> constantNames() { return withBulkModulus(ownNames()); }
  static Constants example() {
    return {{"a", {1500.0}},  {"b", {1.0}},     {"af", {4000.0}},
            {"bf", {1.5}},    {"as", {2000.0}}, {"bs", {1.2}},
            {"afs", {500.0}}, {"bfs", {1.1}},   {"kappa", {1.0e4}}};
  }

  /// a, af, as, afs [Pa], b, bf, bs, bfs; kappa [Pa] or poisson_ratio.
  /// @throws std::invalid_argument, see OwnConstants; a or one of the b not > 0; af, as or afs < 0.
  explicit HolzapfelOgden(const Constants& constants) {
    const OwnConstants own(constants, ownNames());
    matrix_ = {own.positive("a"), own.positive("b")};
    const Vec3 f = Vec3::UnitX(), s = Vec3::UnitY();
    const Mat3 fs = 0.5 * (f * s.transpose() + s * f.transpose());
    fibres_ = {FibreTerm{own.notNegative("af"), own.positive("bf"), f * f.transpose(), true},
               FibreTerm{own.notNegative("as"), own.positive("bs"), s * s.transpose(), true},
               FibreTerm{own.notNegative("afs"), own.positive("bfs"), fs, false}};
    kappa_ = own.bulkModulus(matrix_.a);
  }

  /// Moduli of the matrix at rest.
  Moduli moduli() const { return {matrix_.a, kappa_}; }

  double isochoricEnergy(const Mat3& F) const {
    double W = matrix_.energy(F.squaredNorm() - 3.0);
    for (const FibreTerm& term : fibres_) W += term.energy(F);
    return W;
  }

  Mat3 isochoricStress(const Mat3& F) const {
    Mat3 P = invariantStress(matrix_.derivatives(F.squaredNorm() - 3.0), F);
    for (const FibreTerm& term : fibres_) term.addStress(F, &P);
    return P;
  }

  Mat9 isochoricTangent(const Mat3& F) const {
    Mat9 K = invariantTangent(matrix_.derivatives(F.squaredNorm() - 3.0), F);
    for (const FibreTerm& term : fibres_) term.addTangent(F, &K);
    return K;
  }

 private:
  static std::vector<std::string> ownNames() {
    return {"a", "b", "af", "bf", "as", "bs", "afs", "bfs"};
  }

  FirstInvariantExponential matrix_;
  std::array<FibreTerm, 3> fibres_;
  double kappa_;  // [Pa]
};

}  // namespace palpate::material
