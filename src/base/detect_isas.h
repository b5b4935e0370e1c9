// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/isa.h"

namespace palpate {

/// What availableIsas() says, asked of the processor.
std::vector<Isa> detectIsas();

}  // namespace palpate
