// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace palpate::test {

/// How much memory this program has taken from the heap at most, at one time and by all threads and
/// libraries, since the object was made: above what it had then. One object at a time. Link
/// test/support/heap_peak.cpp, which stands in front of the C library, or listens to the
/// sanitizers.
class HeapPeak {
 public:
  HeapPeak();
  ~HeapPeak();
  HeapPeak(const HeapPeak&) = delete;
  HeapPeak& operator=(const HeapPeak&) = delete;

  std::size_t bytes() const;
};

}  // namespace palpate::test
