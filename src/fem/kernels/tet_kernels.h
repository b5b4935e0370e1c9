// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/isa.h"
#include "tet_batch.h"

namespace palpate::fem {

/// The kernels as built for `isa`, which must be available.
const TetKernels& tetKernels(Isa isa);

}  // namespace palpate::fem
