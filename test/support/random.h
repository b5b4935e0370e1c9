// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>

#include "palpate/base/types.h"

namespace palpate::test {

/// Numbers that are the same in every run: a failure must repeat.
class Random {
 public:
  explicit Random(unsigned seed = 20240229) : engine_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 vector(double spread) {
    return Vec3::NullaryExpr([&] { return uniform(-spread, spread); });
  }
  Mat3 matrix(double spread) {
    return Mat3::NullaryExpr([&] { return uniform(-spread, spread); });
  }
  Points points(Eigen::Index n, double spread) {
    return Points::NullaryExpr(3, n, [&] { return uniform(-spread, spread); });
  }
  Mat3 rotation() {
    return Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))
        .normalized()
        .toRotationMatrix();
  }

 private:
  std::mt19937 engine_;
};

}  // namespace palpate::test
