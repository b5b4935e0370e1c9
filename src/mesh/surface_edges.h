// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// A side of a triangle, from corner `side` to the next.
struct EdgeUse {
  int low, high;  ///< Ends of the edge, low <= high.
  int triangle;
  int side;
  bool forward;  ///< Whether the triangle runs from `low` to `high`.

  bool sameEdge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// All 3 m sides, sorted by edge, then by triangle.
std::vector<EdgeUse> sortedEdges(const Eigen::Matrix3Xi& triangles);

/// Calls `f(first, last)` for each edge with the range of its uses.
template <class F>
void forEachEdge(const std::vector<EdgeUse>& uses, F&& f) {
  for (auto first = uses.begin(); first != uses.end();) {
    auto last = first;
    while (last != uses.end() && last->sameEdge(*first)) ++last;
    f(first, last);
    first = last;
  }
}

/// Disjoint sets with their least elements as representatives.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n);
  int find(int i);
  void join(int a, int b);

 private:
  std::vector<int> parent_;
};

}  // namespace palpate::mesh
