// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/isa.h"
#include "tet_batch.h"

namespace palpate::fem {

/// Kernels compiled for `isa`, which must be available, for elements with 4 or 10 nodes.
template <int N>
const TetKernels<N>& tetKernels(Isa isa);
ExpandRow expandRow(Isa isa);

}  // namespace palpate::fem
