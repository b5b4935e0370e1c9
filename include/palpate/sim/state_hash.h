// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace palpate::sim {

/// 64 bit hash of a sequence of numbers, for comparison of runs; collisions have the probability
/// 2^-64.
///
/// FNV-1a [Fowler, Noll, Vo; RFC 9923] on words of 64 bits in the place of bytes, and a shift that
/// brings high bits down, in four lanes by turns, which are hashed themselves in the end:
///
///     h <- (h ^ word) * 0x100000001b3;  h <- h ^ (h >> 32),   h = 0xcbf29ce484222325 at first
///
/// The words are the bits of doubles in IEEE 754: -0 and 0 differ.
class StateHash {
 public:
  StateHash();

  void add(const double* values, std::size_t count);
  void add(std::uint64_t word);
  std::uint64_t value() const;

 private:
  std::array<std::uint64_t, 4> lanes_;
  std::size_t next_ = 0;  // lane
};

}  // namespace palpate::sim
