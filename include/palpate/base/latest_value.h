// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>

namespace palpate {

/// Passes the newest T from exactly one writer thread to exactly one reader thread.
///
/// Wait-free on both sides: a triple buffer whose middle slot is exchanged atomically. Values that
/// the reader misses are dropped. T's copy assignment must be real-time safe in real-time threads.
template <class T>
class LatestValue {
 public:
  explicit LatestValue(const T& initial = T()) { slots_.fill(initial); }

  /// Writer thread only.
  void write(const T& value) {
    slots_[back_] = value;
    back_ = shared_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader thread only. The reference stays valid until the reader's next call.
  const T& read() {
    if (hasNew()) front_ = shared_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return slots_[front_];
  }

  /// Reader thread only. Whether the next read() returns a new value.
  bool hasNew() const { return (shared_.load(std::memory_order_relaxed) & kFresh) != 0; }

 private:
  static constexpr unsigned kIndex = 3, kFresh = 4;
  std::array<T, 3> slots_;
  alignas(64) unsigned back_ = 0;                // slot of the writer
  alignas(64) std::atomic<unsigned> shared_{1};  // slot in exchange
  alignas(64) unsigned front_ = 2;               // slot of the reader
};

}  // namespace palpate
