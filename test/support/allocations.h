// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace palpate::test {

/// How often this program has taken memory from the heap, by any thread and any library, while
/// counting was on. Link test/support/allocations.cpp, which stands in front of the C library.
std::size_t allocations();
void countAllocations(bool on);

}  // namespace palpate::test
