// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::fem {

/// Clamps the negative eigenvalues of the symmetric `A` to zero; returns at once, leaving every
/// bit, where a Cholesky factorisation shows that there is none to speak of.
void projectToPositiveSemidefinite(Mat9* A);

}  // namespace palpate::fem
