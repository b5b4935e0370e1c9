// SPDX-License-Identifier: GPL-3.0-or-later
#include "bisection_tree.h"

#include <algorithm>
#include <utility>

namespace palpate::mesh {
namespace {

// Whether the permutation `order` of 0 .. 3 is odd.
bool isOdd(const std::array<int, 4>& order) {
  int inversions = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
  }
  return inversions % 2 == 1;
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
    Cell cell;
    cell.vertex = {tet[0], tet[1], tet[2], tet[3]};
    cell.boundary = boundary[static_cast<std::size_t>(t)];
    cell.odd = false;
    addCell(cell, signedVolume(mesh.points, tet));
  }
  for (Eigen::Index t = 0; t < mesh.midnodes.cols(); ++t) {
    for (int k = 0; k < 6; ++k) {
      const auto [i, j] = kMiddlesBetween[k];
      Edge& edge = edges_[edgeBetween(mesh.tets(i, t), mesh.tets(j, t))];
      edge.middle = mesh.midnodes(k, t);
      vertices_[edge.middle] = {edge.a, edge.b, 1};
      rest_[edge.middle] = 0.5 * (rest_[edge.a] + rest_[edge.b]);
    }
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

// Sort key of an edge: its length, then its midpoint for equal lengths. The order of two edges is
// thus equal in all cells and independent of numbering.
std::array<double, 4> BisectionTree::rank(int a, int b) const {
  const Vec3 twice_middle = rest_[a] + rest_[b];
  return {(rest_[a] - rest_[b]).squaredNorm(), twice_middle[0], twice_middle[1], twice_middle[2]};
}

// Moves the longest edge to the front.
void BisectionTree::order(Cell* cell) const {
  const std::array<int, 4> v = cell->vertex;
  std::pair<int, int> longest{0, 1};
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b) {
      if (rank(v[longest.first], v[longest.second]) < rank(v[a], v[b])) longest = {a, b};
    }
  }
  std::array<int, 4> place{longest.first, longest.second, -1, -1};
  for (int k = 0, at = 2; k < 4; ++k) {
    if (k != longest.first && k != longest.second) place[at++] = k;
  }
  const std::uint8_t boundary = cell->boundary;
  cell->boundary = 0;
  for (int k = 0; k < 4; ++k) {
    cell->vertex[k] = v[place[k]];
    if (boundary >> place[k] & 1) cell->boundary |= 1 << k;
  }
  cell->odd = cell->odd != isOdd(place);
}

void BisectionTree::addCell(Cell cell, double volume) {
  order(&cell);
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
  addChild(c, 1, middle);
  addChild(c, 0, middle);
}

// Adds the child in which `middle` replaces the parent's vertex `lost`, 0 or 1. The face opposite
// `middle` is the parent's, the face opposite the kept vertex is new, and the other two are halves.
void BisectionTree::addChild(int parent, int lost, int middle) {
  Cell child;
  child.vertex = cells_[parent].vertex;
  child.vertex[lost] = middle;
  child.parent = parent;
  child.boundary = static_cast<std::uint8_t>(cells_[parent].boundary & ~(1 << (1 - lost)));
  child.odd = cells_[parent].odd;
  addCell(child, 0.5 * volume_[parent]);
}

}  // namespace palpate::mesh
