// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/state_hash.h"

#include <cstring>

namespace palpate::sim {
namespace {

constexpr std::uint64_t kBasis = 0xcbf29ce484222325ULL, kPrime = 0x100000001b3ULL;

std::uint64_t mixed(std::uint64_t h, std::uint64_t word) {
  h = (h ^ word) * kPrime;
  return h ^ (h >> 32);
}

std::uint64_t bitsOf(const double* value) {
  std::uint64_t bits;
  std::memcpy(&bits, value, sizeof bits);
  return bits;
}

}  // namespace

StateHash::StateHash() {
  for (std::size_t k = 0; k < lanes_.size(); ++k) lanes_[k] = mixed(kBasis, k);
}

void StateHash::add(std::uint64_t word) {
  lanes_[next_] = mixed(lanes_[next_], word);
  next_ = (next_ + 1) % lanes_.size();
}

void StateHash::add(const double* values, std::size_t count) {
  std::size_t k = 0;
  while (k < count && next_ != 0) add(bitsOf(values + k++));
  // The lanes do not wait for each other.
  auto [a, b, c, d] = lanes_;
  for (; k + 4 <= count; k += 4) {
    a = mixed(a, bitsOf(values + k));
    b = mixed(b, bitsOf(values + k + 1));
    c = mixed(c, bitsOf(values + k + 2));
    d = mixed(d, bitsOf(values + k + 3));
  }
  lanes_ = {a, b, c, d};
  while (k < count) add(bitsOf(values + k++));
}

std::uint64_t StateHash::value() const {
  std::uint64_t h = mixed(kBasis, next_);
  for (const std::uint64_t lane : lanes_) h = mixed(h, lane);
  return h;
}

}  // namespace palpate::sim
