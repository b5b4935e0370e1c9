// SPDX-License-Identifier: GPL-3.0-or-later
#include "leaves.h"

#include <algorithm>
#include <array>
#include <utility>

namespace palpate::mesh {
namespace {

// Faces of a tetrahedron of positive volume: face k is opposite corner k, outward.
constexpr int kLeafFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// Points of `l` with `asked(vertex)` that are midpoints, in an order in which ends come first.
template <class Asked>
std::vector<MeshChange::Middle> middlesOf(const BisectionTree& tree, const Leaves& l,
                                          const Asked& asked) {
  std::vector<MeshChange::Middle> middles;
  for (std::size_t i = 0; i < l.vertices.size(); ++i) {
    const BisectionTree::Vertex& vertex = tree.vertex(l.vertices[i]);
    if (vertex.a < 0 || !asked(l.vertices[i])) continue;
    middles.push_back({static_cast<int>(i), l.number[vertex.a], l.number[vertex.b]});
  }
  std::stable_sort(middles.begin(), middles.end(), [&](const auto& m, const auto& n) {
    return tree.vertex(l.vertices[m.point]).depth < tree.vertex(l.vertices[n.point]).depth;
  });
  return middles;
}

// Both lists of leaves are in tree order, so descendants of a cell are consecutive.
void addTets(const BisectionTree& tree, const Leaves& old, const Cut& old_cut, const Leaves& next,
             MeshChange* change) {
  std::vector<int> old_tet(static_cast<std::size_t>(tree.numCells()), -1);
  for (std::size_t t = 0; t < old.cells.size(); ++t) old_tet[old.cells[t]] = static_cast<int>(t);
  for (int cell : next.cells) {
    int first = cell, last = cell;
    if (old_cut.has(cell)) {
      while (old_cut.has(first)) first = tree.cell(first).child;
      while (old_cut.has(last)) last = tree.cell(last).child + 1;
    } else {
      while (old_tet[first] < 0) first = tree.cell(first).parent;
      last = first;
    }
    change->tets.push_back({old_tet[first], old_tet[last] + 1});
  }
}

}  // namespace

void Cut::cover(const BisectionTree& tree) {
  cells.resize(static_cast<std::size_t>(tree.numCells()), 0);
  edges.resize(static_cast<std::size_t>(tree.numEdges()), 0);
}

Leaves::Leaves(BisectionTree* with_tree, int num_roots, const Cut& cut, bool quadratic)
    : number(static_cast<std::size_t>(with_tree->numVertices()), -1) {
  const BisectionTree& tree = *with_tree;
  std::vector<std::array<int, 4>> tets;
  std::vector<std::array<int, 3>> triangles;
  forCells(tree, num_roots, cut, [&](int c, int root) {
    if (cut.cells[c]) return;
    const BisectionTree::Cell& cell = tree.cell(c);
    std::array<int, 4> tet;
    for (int k = 0; k < 4; ++k) {
      const int v = cell.vertex[place(cell, k)];
      if (number[v] < 0) {
        number[v] = static_cast<int>(vertices.size());
        vertices.push_back(v);
      }
      tet[k] = number[v];
    }
    for (int k = 0; k < 4; ++k) {
      if (cell.boundary >> place(cell, k) & 1) {
        triangles.push_back({tet[kLeafFaces[k][0]], tet[kLeafFaces[k][1]], tet[kLeafFaces[k][2]]});
      }
    }
    tets.push_back(tet);
    cells.push_back(c);
    coarse_tets.push_back(root);
  });
  mesh.points.resize(3, static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    mesh.points.col(static_cast<Eigen::Index>(i)) = tree.rest(vertices[i]);
  }
  mesh.tets.resize(4, static_cast<Eigen::Index>(tets.size()));
  for (std::size_t t = 0; t < tets.size(); ++t) {
    mesh.tets.col(static_cast<Eigen::Index>(t)) = Eigen::Vector4i(tets[t].data());
  }
  surface.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    surface.col(static_cast<Eigen::Index>(t)) = Eigen::Vector3i(triangles[t].data());
  }
  if (quadratic) addMiddleNodes(with_tree);
  middles = middlesOf(tree, *this, [](int) { return true; });
}

bool Leaves::conform(const BisectionTree& tree, const Cut& cut) const {
  return std::none_of(cells.begin(), cells.end(), [&](int c) {
    const auto& edges = tree.cell(c).edge;
    return std::any_of(edges.begin(), edges.end(), [&](int e) { return cut.edges[e] != 0; });
  });
}

MeshChange changeBetween(const BisectionTree& tree, const Leaves& old, const Cut& old_cut,
                         const Leaves& next) {
  MeshChange change;
  change.num_old_points = static_cast<int>(old.vertices.size());
  for (int v : next.vertices) change.old_point.push_back(old.find(v));
  addTets(tree, old, old_cut, next, &change);
  if (next.mesh.quadratic()) {
    addQuadraticChange(tree, old, next, &change);
    return change;
  }
  change.added = middlesOf(tree, next, [&](int v) { return old.find(v) < 0; });
  change.removed = middlesOf(tree, old, [&](int v) { return next.find(v) < 0; });
  std::reverse(change.removed.begin(), change.removed.end());
  return change;
}

}  // namespace palpate::mesh
