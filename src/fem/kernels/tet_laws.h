// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/lanes.h"

// For kernels only: laws psi(I1, J) + kappa/2 (J - 1)^2 + p J, I1 = F : F, for a register of
// points. Computes the factors of F, cof F and their products in stress and tangent. Formulas as in
// material/neo_hookean.h and material/stable_neo_hookean.h.

namespace palpate::fem {
namespace {

struct LawPoints {
  Lanes psi;  ///< [J/m^3], without p J.
  Lanes f;    ///< P = f F + c cof F; f is also the factor of I in dP/dF.
  Lanes c;    ///< c is also the factor of d cof F/dF.
  Lanes cc;   ///< Factor of cof F (x) cof F.
  Lanes fc;   ///< Factor of F (x) cof F + cof F (x) F.
};

/// mu/2 (J^(-2/3) I1 - 3), infinite for J <= 0.
struct NeoHookeanPoints {
  double mu, kappa;

  LawPoints at(Lanes I1, Lanes J, Lanes p) const {
    const Lanes r = inverseCubeRoot(J);
    const Lanes a = mu * (r * r);
    const Lanes inverse_J = r * r * r;
    const Lanes dJ = J - 1.0;
    const Lanes a_I1 = a * I1 * inverse_J;
    LawPoints point;
    point.psi = 0.5 * (a * I1 - 3.0 * mu) + (0.5 * kappa) * (dJ * dJ);
    point.psi = select(J > 0.0, point.psi, all(__builtin_inf()));
    point.f = a;
    point.c = kappa * dJ + p - (1.0 / 3.0) * a_I1;
    point.cc = kappa + (5.0 / 9.0) * (a_I1 * inverse_J);
    point.fc = (-2.0 / 3.0) * (a * inverse_J);
    return point;
  }
};

/// mu/2 (I1 - 3) - mu (J - 1) + mu/6 (J - 1)^2.
struct StableNeoHookeanPoints {
  double mu, kappa;

  LawPoints at(Lanes I1, Lanes J, Lanes p) const {
    const Lanes dJ = J - 1.0;
    LawPoints point;
    point.psi = mu * (0.5 * (I1 - 3.0) - dJ + (1.0 / 6.0) * (dJ * dJ)) + (0.5 * kappa) * (dJ * dJ);
    point.f = all(mu);
    point.c = (kappa + mu / 3.0) * dJ + p - mu;
    point.cc = all(kappa + mu / 3.0);
    point.fc = Lanes{};
    return point;
  }
};

}  // namespace
}  // namespace palpate::fem
