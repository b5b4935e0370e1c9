// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace palpate {

/// FNV-1a over 64-bit words, with a stronger mix [Steele et al. 2014, SplitMix64's finaliser]. Not
/// cryptographic.
class ContentHash {
 public:
  explicit ContentHash(std::uint64_t seed) : state_(seed) {}

  void add(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x100000001b3ULL;
    state_ ^= state_ >> 30;
    state_ *= 0xbf58476d1ce4e5b9ULL;
    state_ ^= state_ >> 27;
  }
  void add(const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    add(static_cast<std::uint64_t>(bytes));
    for (std::size_t i = 0; i < bytes; i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, from + i, std::min<std::size_t>(8, bytes - i));
      add(word);
    }
  }
  void add(std::string_view bytes) { add(bytes.data(), bytes.size()); }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_;
};

}  // namespace palpate
