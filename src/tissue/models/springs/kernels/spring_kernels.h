// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/isa.h"
#include "spring_span.h"

namespace palpate::tissue {

/// The same bits for every isa.
SpringKernel springKernel(Isa isa);

}  // namespace palpate::tissue
