// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/hilbert_order.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace palpate::mesh {
namespace {

constexpr int kBits = 20;  // per axis: 60 of 64 bits

/// Position on the Hilbert curve [Skilling 2004, "Programming the Hilbert curve", AxestoTranspose].
std::uint64_t hilbertKey(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1U << (kBits - 1); q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (auto& axis : x) {
      if (axis & q) {
        x[0] ^= p;
      } else {
        const std::uint32_t t = (x[0] ^ axis) & p;
        x[0] ^= t;
        axis ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1U << (kBits - 1); q > 1; q >>= 1) {
    if (x[2] & q) t ^= q - 1;
  }
  std::uint64_t key = 0;
  for (int bit = kBits - 1; bit >= 0; --bit) {
    for (const std::uint32_t axis : x) key = key << 1 | ((axis ^ t) >> bit & 1U);
  }
  return key;
}

std::vector<std::uint64_t> hilbertKeys(const Points& points) {
  const Vec3 low = points.rowwise().minCoeff();
  const double side = (points.rowwise().maxCoeff() - low).maxCoeff();
  const double scale = side > 0.0 ? ((1U << kBits) - 1) / side : 0.0;
  std::vector<std::uint64_t> keys;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3 cell = scale * (points.col(i) - low);
    keys.push_back(
        hilbertKey({static_cast<std::uint32_t>(cell.x()), static_cast<std::uint32_t>(cell.y()),
                    static_cast<std::uint32_t>(cell.z())}));
  }
  return keys;
}

}  // namespace

std::vector<int> hilbertOrder(const Points& points) {
  std::vector<int> order(static_cast<std::size_t>(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  if (order.empty()) return order;
  const std::vector<std::uint64_t> keys = hilbertKeys(points);
  const auto place = [&](int i) {
    return std::make_tuple(keys[i], points(0, i), points(1, i), points(2, i));
  };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return place(i) < place(j); });
  return order;
}

}  // namespace palpate::mesh
