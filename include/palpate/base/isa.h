// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace palpate {

/// Vector instructions that kernels are built for. Every build of a kernel gives the same bits.
enum class Isa {
  kBaseline,  ///< What every processor of the architecture has: SSE2 on x86-64.
  kAvx2,
  kAvx512,
};

std::string_view toString(Isa isa);

/// Those that were built and that this processor has, from slowest to fastest.
const std::vector<Isa>& availableIsas();

/// The fastest.
inline Isa bestIsa() { return availableIsas().back(); }

}  // namespace palpate
