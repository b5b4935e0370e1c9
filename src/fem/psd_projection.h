// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::fem {

/// What projectToPositiveSemidefinite() did: nothing, for no negative eigenvalue matters or A is
/// not finite; or a projection by known eigenvectors, or by a full decomposition.
enum class Projected { kNothing, kByKnown, kByAll };

/// Clamps the negative eigenvalues of `A`, the symmetric tangent d2 psi / d vec F^2 at F, to zero.
/// Leaves A bitwise unchanged if a Cholesky factorisation finds none that matters.
///
/// For isotropic laws the principal stretches of F give the eigenvectors: three span the stretch
/// modes, the others are flip and twist modes [Smith, de Goes, Kim 2019, sect. 4]. The code
/// verifies this; any other A gets a full decomposition, which takes several times as long.
Projected projectToPositiveSemidefinite(const Mat3& F, Mat9* A);

}  // namespace palpate::fem
