// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/surface_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace palpate::contact {
namespace {

// A surface whose longest edge is so many times the mean of its triangles' longest ones has fine
// and coarse parts. Uniform meshes of the volume mesher have 1.3 to 1.55.
constexpr double kGraded = 1.75;

// In these, however small a triangle is: with samples at nodes alone, a ball pressed into edges of
// a quarter of its radius turned elements inside out between them, and with two parts its force is
// 0.5 % lower than with five.
constexpr int kLeastParts = 3;

// (node, lattice weight), sorted, zero weights last with node -1: the same for all triangles that
// share the point, whatever parts their edges have.
using Key = std::array<std::pair<int, int>, 3>;

Key keyOf(const Eigen::Vector3i& nodes, const std::array<int, 3>& weights) {
  const int common = std::gcd(std::gcd(weights[0], weights[1]), weights[2]);
  Key key;
  for (int k = 0; k < 3; ++k) {
    key[k] = weights[k] > 0 ? std::make_pair(nodes[k], weights[k] / common) : std::make_pair(-1, 0);
  }
  std::sort(key.begin(), key.end(), std::greater<>());
  return key;
}

double longestEdge(const Points& X, const Eigen::Vector3i& triangle) {
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = X.col(triangle[(k + 1) % 3]) - X.col(triangle[k]);
    longest = std::max(longest, edge.norm());
  }
  return longest;
}

int partsOf(double edge, double spacing) {
  return static_cast<int>(std::clamp(std::ceil(edge / spacing), 1.0, double{kMaxDivisions}));
}

// Into how many parts the edges of each triangle are cut.
std::vector<int> divisions(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing) {
  const std::size_t count = static_cast<std::size_t>(triangles.cols());
  if (!(spacing > 0.0) || count == 0) return std::vector<int>(count, 1);
  std::vector<double> edges;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    edges.push_back(longestEdge(X, triangles.col(t)));
  }
  const double longest = *std::max_element(edges.begin(), edges.end());
  const double mean = std::accumulate(edges.begin(), edges.end(), 0.0) / static_cast<double>(count);
  const bool graded = longest > kGraded * mean;
  std::vector<int> parts;
  for (const double edge : edges) {
    const int own = std::max(kLeastParts, partsOf(edge, spacing));
    parts.push_back(graded ? own : partsOf(longest, spacing));
  }
  return parts;
}

}  // namespace

std::vector<SurfaceSample> sampleSurface(const Points& X, const Eigen::Matrix3Xi& triangles,
                                         double spacing) {
  const std::vector<int> parts = divisions(X, triangles, spacing);
  std::vector<SurfaceSample> samples;
  std::map<Key, std::size_t> known;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Vector3i nodes = triangles.col(t);
    const int n = parts[static_cast<std::size_t>(t)];
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
