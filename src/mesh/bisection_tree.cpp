// SPDX-License-Identifier: GPL-3.0-or-later
#include "bisection_tree.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace palpate::mesh {
namespace {

constexpr int kEdgeOf[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};

// Whether `order`, a permutation of 0 .. 3, is odd.
bool isOdd(const std::array<int, 4>& order) {
  int inversions = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
  }
  return inversions % 2 == 1;
}

// A strict order of the edges of the coarse mesh, the same in all its tetrahedra.
class EdgeOrder {
 public:
  EdgeOrder(const TetMesh& mesh, const Eigen::Vector4i& tet) : mesh_(mesh), tet_(tet) {}
  bool less(std::pair<int, int> e, std::pair<int, int> f) const { return key(e) < key(f); }

 private:
  std::tuple<double, int, int> key(std::pair<int, int> e) const {
    const auto [low, high] = std::minmax(tet_[e.first], tet_[e.second]);
    return {(mesh_.points.col(low) - mesh_.points.col(high)).squaredNorm(), low, high};
  }
  const TetMesh& mesh_;
  Eigen::Vector4i tet_;
};

// Which of the edges x2, x3, 23 of a face, x, p2, p3 of them, is the largest.
std::uint8_t largestOf(const EdgeOrder& order, int x, int p2, int p3) {
  const std::pair<int, int> edges[3] = {{x, p2}, {x, p3}, {p2, p3}};
  std::uint8_t largest = 0;
  for (std::uint8_t k = 1; k < 3; ++k) {
    if (order.less(edges[largest], edges[k])) largest = k;
  }
  return largest;
}

}  // namespace

BisectionTree::BisectionTree(const TetMesh& mesh) {
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    vertices_.push_back({});
    rest_.push_back(mesh.points.col(i));
  }
  const std::vector<std::uint8_t> boundary = outerSides(mesh.tets);
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    const Eigen::Vector4i tet = mesh.tets.col(t);
    const EdgeOrder edges(mesh, tet);
    std::pair<int, int> longest{0, 1};
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) {
        if (edges.less(longest, {a, b})) longest = {a, b};
      }
    }
    std::array<int, 4> order{longest.first, longest.second, -1, -1};
    for (int k = 0, at = 2; k < 4; ++k) {
      if (k != longest.first && k != longest.second) order[at++] = k;
    }
    Cell cell;
    cell.boundary = 0;
    for (int k = 0; k < 4; ++k) {
      cell.vertex[k] = tet[order[k]];
      if (boundary[static_cast<std::size_t>(t)] & (1 << order[k])) cell.boundary |= 1 << k;
    }
    cell.mark = {largestOf(edges, order[0], order[2], order[3]),
                 largestOf(edges, order[1], order[2], order[3])};
    cell.flag = false;
    cell.odd = isOdd(order);
    addCell(cell, signedVolume(mesh.points, tet));
  }
}

int BisectionTree::edgeBetween(int a, int b) {
  const auto [low, high] = std::minmax(a, b);
  const std::uint64_t key =
      static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
  const auto [at, fresh] = edge_number_.emplace(key, static_cast<int>(edges_.size()));
  if (fresh) edges_.push_back({low, high, -1, {}});
  return at->second;
}

int BisectionTree::middleOf(int edge) {
  Edge& e = edges_[edge];
  if (e.middle >= 0) return e.middle;
  e.middle = static_cast<int>(vertices_.size());
  vertices_.push_back({e.a, e.b, 1 + std::max(vertices_[e.a].depth, vertices_[e.b].depth)});
  rest_.push_back(0.5 * (rest_[e.a] + rest_[e.b]));
  return e.middle;
}

void BisectionTree::addCell(const Cell& cell, double volume) {
  const int c = static_cast<int>(cells_.size());
  cells_.push_back(cell);
  volume_.push_back(volume);
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      const int e = edgeBetween(cell.vertex[i], cell.vertex[j]);
      cells_.back().edge[kEdgeOf[i][j]] = e;
      edges_[e].cells.push_back(c);
    }
  }
}

void BisectionTree::bisect(int c) {
  const int middle = middleOf(cells_[c].edge[0]);
  cells_[c].child = static_cast<int>(cells_.size());
  addChild(c, 0, middle);
  addChild(c, 1, middle);
}

// The child with the parent's vertex `kept`, 0 or 1, and the middle in the place of the other one.
void BisectionTree::addChild(int parent, int kept, int middle) {
  const Cell p = cells_[parent];
  const int lost = 1 - kept;
  // Its new edge is the marked one of the face that it has from the parent: between places from and
  // to of the parent; `rest` is the third one there.
  const int mark = p.mark[kept];
  const int from = mark == 2 ? 2 : kept, to = mark == 0 ? 2 : 3;
  const int rest = kept + 2 + 3 - from - to;
  Cell child;
  child.parent = parent;
  child.vertex = {p.vertex[from], p.vertex[to], p.vertex[rest], middle};
  std::array<int, 4> order{from, to, rest, lost};
  child.odd = p.odd != isOdd(order);
  // The face opposite a vertex: of the inherited ones that of the middle, cut ones those of 2
  // and 3.
  const auto onBoundary = [&](int place) { return (p.boundary >> place & 1) != 0; };
  child.boundary = 0;
  for (int k = 0; k < 3; ++k) {
    if (order[k] >= 2 && onBoundary(order[k])) child.boundary |= 1 << k;
  }
  if (onBoundary(lost)) child.boundary |= 1 << 3;
  // On cut faces the edge opposite the middle; on the new face too, but in the children of a
  // flagged planar one the edge from the middle to the edge that is next.
  const bool planar = p.mark[0] == p.mark[1] && p.mark[0] != 2;
  child.mark = {0, static_cast<std::uint8_t>(planar && p.flag ? 1 : 0)};
  child.flag = planar && !p.flag;
  addCell(child, 0.5 * volume_[parent]);
}

}  // namespace palpate::mesh
