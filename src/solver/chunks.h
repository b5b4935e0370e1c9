// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>

#include "palpate/base/thread_pool.h"

namespace palpate::solver {

/// Loops over slices in chunks of fixed size, so that sums over chunks are bitwise independent of
/// threads.
class Chunks {
 public:
  static constexpr int kSlices = 16;  ///< Slices per chunk; a chunk is processed by one thread.

  explicit Chunks(ThreadPool* pool) : pool_(pool) {}

  static int number(int slices) { return (slices + kSlices - 1) / kSlices; }

  /// Reverses the direction of all later loops. What a thread read last, still in the cache, is
  /// then read first.
  void turn() { backwards_ = !backwards_; }
  bool backwards() const { return backwards_; }

  /// Calls body(first, last) with the chunks of each thread.
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
  /// The k-th chunk of [first, last) in the present direction.
  int at(int k, int first, int last) const { return backwards_ ? last - 1 - k : first + k; }
  /// Calls body(begin, end) with the slices of a chunk.
  template <class Body>
  static void slicesOf(int chunk, int slices, const Body& body) {
    body(kSlices * chunk, std::min(kSlices * (chunk + 1), slices));
  }
  /// Calls body(chunk, begin, end) for all chunks.
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
  static constexpr int kWorthThreads = 2;  // least number of chunks for threads

  ThreadPool* pool_;
  bool backwards_ = false;
};

}  // namespace palpate::solver
