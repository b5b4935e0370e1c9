// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::fem {

/// How it went: nothing was negative, the eigenvectors were known, or all were computed.
enum class Projected { kNothing, kByKnown, kByAll };

/// Clamps the negative eigenvalues of `A`, the symmetric tangent d2 psi / d vec F^2 at F, to zero;
/// leaves every bit where a Cholesky factorisation shows that there is none to speak of.
///
/// Of isotropic laws the eigenvectors are known by the principal stretches of F: three lie in the
/// span of the stretch modes, the others are the flip and twist modes [Smith, de Goes, Kim 2019,
/// sect. 4]. That they are ones is looked at; of any other A all eigenvectors are computed, which
/// takes several times as long.
Projected projectToPositiveSemidefinite(const Mat3& F, Mat9* A);

}  // namespace palpate::fem
