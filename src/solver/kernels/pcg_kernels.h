// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/isa.h"
#include "pcg_arrays.h"

namespace palpate::solver {

/// Kernels compiled for `isa`, which must be available.
const PcgKernels& pcgKernels(Isa isa);

}  // namespace palpate::solver
