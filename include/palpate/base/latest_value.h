// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>

namespace palpate {

/// Hands the newest T from exactly one writer thread to exactly one reader thread.
///
/// Wait-free on both sides: no lock, no retry (a triple buffer whose middle slot changes hands by
/// one atomic exchange). Values that the reader is too slow to see are dropped. T's copy
/// assignment must itself be real-time safe where a real-time thread writes or reads.
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

  /// Reader thread only. Whether the next read() returns a value not read before.
  bool hasNew() const { return (shared_.load(std::memory_order_relaxed) & kFresh) != 0; }

 private:
  static constexpr unsigned kIndex = 3, kFresh = 4;
  std::array<T, 3> slots_;
  alignas(64) unsigned back_ = 0;                // the writer's
  alignas(64) std::atomic<unsigned> shared_{1};  // changes hands
  alignas(64) unsigned front_ = 2;               // the reader's
};

}  // namespace palpate
