// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace palpate::mesh {

std::vector<EdgeUse> sortedEdges(const Eigen::Matrix3Xi& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.cols());
  for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) {
    for (int side = 0; side < 3; ++side) {
      const int a = triangles(side, t), b = triangles((side + 1) % 3, t);
      uses.push_back({std::min(a, b), std::max(a, b), t, side, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle, a.side) <
           std::tie(b.low, b.high, b.triangle, b.side);
  });
  return uses;
}

UnionFind::UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

int UnionFind::find(int i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

void UnionFind::join(int a, int b) {
  a = find(a);
  b = find(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

}  // namespace palpate::mesh
