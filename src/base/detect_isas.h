// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/isa.h"

namespace palpate {

/// Instruction sets that the processor reports, for availableIsas().
std::vector<Isa> detectIsas();

}  // namespace palpate
