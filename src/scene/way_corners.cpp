// SPDX-License-Identifier: GPL-3.0-or-later
#include "way_corners.h"

#include <algorithm>
#include <utility>

#include "palpate/mesh/size_field.h"

namespace palpate::scene {
namespace {

constexpr std::size_t kPart = 4000;

// Point between both ends farthest from their line; `first` if all are within `deviation`.
std::size_t farthestOf(const std::vector<Vec3>& points, std::size_t first, std::size_t last,
                       double deviation) {
  std::size_t farthest = first;
  double most = deviation;
  const mesh::Polyline line{{points[first], points[last]}};
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = mesh::distanceTo(line, points[i]);
    if (distance <= most) continue;
    most = distance;
    farthest = i;
  }
  return farthest;
}

}  // namespace

std::vector<Vec3> wayCorners(const std::vector<Vec3>& points, double deviation) {
  std::vector<Vec3> kept{points.front()};
  for (std::size_t begin = 0; begin + 1 < points.size(); begin += kPart) {
    // Stack of open parts instead of recursion, whose depth a spiral would make the number of
    // points.
    std::vector<std::pair<std::size_t, std::size_t>> parts{
        {begin, std::min(begin + kPart, points.size() - 1)}};
    while (!parts.empty()) {
      const auto [first, last] = parts.back();
      parts.pop_back();
      const std::size_t corner = farthestOf(points, first, last, deviation);
      if (corner == first) {
        kept.push_back(points[last]);
      } else {
        parts.emplace_back(corner, last);
        parts.emplace_back(first, corner);
      }
    }
  }
  return kept;
}

}  // namespace palpate::scene
