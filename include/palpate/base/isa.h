// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace palpate {

/// Vector instruction sets of kernel builds. All builds give the same bits.
enum class Isa {
  kBaseline,  ///< Minimum of the architecture: SSE2 on x86-64.
  kAvx2,
  kAvx512,
};

std::string_view toString(Isa isa);

/// Instruction sets both built and supported by this processor, slowest first.
const std::vector<Isa>& availableIsas();

/// The fastest available set.
inline Isa bestIsa() { return availableIsas().back(); }

}  // namespace palpate
