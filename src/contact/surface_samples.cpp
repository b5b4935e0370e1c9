// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/surface_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace palpate::contact {
namespace {

// (node, lattice weight), sorted, zero weights last with node -1: the same for all triangles that
// share the point.
using Key = std::array<std::pair<int, int>, 3>;

Key keyOf(const Eigen::Vector3i& nodes, const std::array<int, 3>& weights) {
  Key key;
  for (int k = 0; k < 3; ++k) {
    key[k] = weights[k] > 0 ? std::make_pair(nodes[k], weights[k]) : std::make_pair(-1, 0);
  }
  std::sort(key.begin(), key.end(), std::greater<>());
  return key;
}

int divisions(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing) {
  if (!(spacing > 0.0)) return 1;
  double longest = 0.0;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = X.col(triangles((k + 1) % 3, t)) - X.col(triangles(k, t));
      longest = std::max(longest, edge.norm());
    }
  }
  return static_cast<int>(std::clamp(std::ceil(longest / spacing), 1.0, double{kMaxDivisions}));
}

}  // namespace

std::vector<SurfaceSample> sampleSurface(const Points& X, const Eigen::Matrix3Xi& triangles,
                                         double spacing) {
  const int n = divisions(X, triangles, spacing);
  std::vector<SurfaceSample> samples;
  std::map<Key, std::size_t> known;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Vector3i nodes = triangles.col(t);
    const Vec3 a = X.col(nodes[0]);
    const double area =
        0.5 * (X.col(nodes[1]) - a).cross(Vec3(X.col(nodes[2])) - a).norm() / (n * n);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const int k = n - i - j;
        const auto [it, is_new] = known.try_emplace(keyOf(nodes, {i, j, k}), samples.size());
        if (is_new) samples.push_back({nodes, Vec3(i, j, k) / n, 0.0});
        // Small triangles that meet here: six inside, three on an edge, one at a corner.
        const int zeros = (i == 0) + (j == 0) + (k == 0);
        const double share = zeros == 0 ? 6.0 : zeros == 1 ? 3.0 : 1.0;
        samples[it->second].area += share * area / 3.0;
      }
    }
  }
  return samples;
}

}  // namespace palpate::contact
