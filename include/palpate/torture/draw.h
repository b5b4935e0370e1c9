// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::torture {

/// Random numbers from a seed and a number, equal on every machine: SplitMix64 [Steele, Lea, Flood
/// 2014], begun at a hash of both.
class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t number);

  double between(double low, double high);  ///< Uniform in [low, high).
  double decades(double low, double high);  ///< Uniform in the logarithm, both > 0.
  int whole(int count);                     ///< 0 ... count - 1.
  bool chance(double p);
  Vec3 direction();  ///< Unit, uniform on the sphere.
  Vec3 within(const Vec3& low, const Vec3& high);

  template <class T>
  const T& oneOf(const std::vector<T>& all) {
    return all[static_cast<std::size_t>(whole(static_cast<int>(all.size())))];
  }

 private:
  std::uint64_t next();
  std::uint64_t state_;
};

}  // namespace palpate::torture
