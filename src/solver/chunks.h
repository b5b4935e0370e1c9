// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>

#include "palpate/base/thread_pool.h"

namespace palpate::solver {

/// Loops over slices in chunks of a fixed size, so that threads never change a bit of a sum over
/// chunks.
class Chunks {
 public:
  static constexpr int kSlices = 16;  ///< Of a chunk, which one thread works through in one go.

  explicit Chunks(ThreadPool* pool) : pool_(pool) {}

  static int number(int slices) { return (slices + kSlices - 1) / kSlices; }

  /// From now on every thread works through its part in the other direction. What it read last is
  /// then read first, while it is still in the cache.
  void turn() { backwards_ = !backwards_; }
  bool backwards() const { return backwards_; }

  /// body(first, last): the chunks of one thread.
  template <class Body>
  void forParts(int slices, const Body& body) const {
    const int chunks = number(slices);
    if (pool_ && chunks >= kWorthThreads) {
      pool_->forRanges(static_cast<std::size_t>(chunks), [&](std::size_t first, std::size_t last) {
        body(static_cast<int>(first), static_cast<int>(last));
      });
    } else {
      body(0, chunks);
    }
  }
  /// Chunk k of those from `first` to `last`, in the present direction.
  int at(int k, int first, int last) const { return backwards_ ? last - 1 - k : first + k; }
  /// body(begin, end): the slices of a chunk.
  template <class Body>
  static void slicesOf(int chunk, int slices, const Body& body) {
    body(kSlices * chunk, std::min(kSlices * (chunk + 1), slices));
  }
  /// body(chunk, begin, end), for all.
  template <class Body>
  void forAll(int slices, const Body& body) const {
    forParts(slices, [&](int first, int last) {
      for (int k = 0; k < last - first; ++k) {
        const int chunk = at(k, first, last);
        slicesOf(chunk, slices, [&](int begin, int end) { body(chunk, begin, end); });
      }
    });
  }

 private:
  static constexpr int kWorthThreads = 2;  // chunks

  ThreadPool* pool_;
  bool backwards_ = false;
};

}  // namespace palpate::solver
