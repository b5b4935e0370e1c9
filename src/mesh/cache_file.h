// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace palpate::mesh {

/// FNV-1a over 64-bit words, with a stronger mix [Steele et al. 2014, SplitMix64's finaliser].
/// Not against malice.
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
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_;
};

/// The file in the cache for what has these two hashes; `ending` with its dot.
std::string cachePath(const std::string& cache_directory, std::uint64_t first, std::uint64_t second,
                      const std::string& ending);

/// Writes it whole, with its folder. Failure is silent: the next start computes again.
void writeCacheFile(const std::string& path, std::string_view bytes);

}  // namespace palpate::mesh
