// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "bisection_tree.h"
#include "palpate/mesh/mesh_change.h"

namespace palpate::mesh {

/// The cells of a tree that are bisected, and the edges that are by that.
struct Cut {
  std::vector<char> cells, edges;

  /// Brings it to the tree's size.
  void cover(const BisectionTree& tree);
  bool has(int cell) const { return cell < static_cast<int>(cells.size()) && cells[cell]; }
};

/// visit(cell, root) on all cells that are there, parents first, below each of the roots.
template <class Visit>
void forCells(const BisectionTree& tree, int num_roots, const Cut& cut, const Visit& visit) {
  std::vector<int> stack;
  for (int root = 0; root < num_roots; ++root) {
    stack.assign(1, root);
    while (!stack.empty()) {
      const int c = stack.back();
      stack.pop_back();
      visit(c, root);
      if (!cut.cells[c]) continue;
      stack.push_back(tree.cell(c).child + 1);
      stack.push_back(tree.cell(c).child);
    }
  }
}

/// The mesh of the cells that are not cut, in the order of the trees; points in the order in which
/// its tetrahedra name them, corners before middle nodes. A middle node is the vertex that would
/// cut its edge.
struct Leaves {
  Leaves() = default;
  /// `quadratic`: with middle nodes, for which `tree` gets the vertices that it has not yet.
  Leaves(BisectionTree* tree, int num_roots, const Cut& cut, bool quadratic);

  /// Whether a point hangs in the middle of an edge.
  bool conform(const BisectionTree& tree, const Cut& cut) const;
  /// Number of a vertex, or -1.
  int find(int vertex) const {
    return vertex < static_cast<int>(number.size()) ? number[vertex] : -1;
  }
  /// The cell's vertex that is corner `corner` of its tetrahedron.
  static int place(const BisectionTree::Cell& cell, int corner) {
    return cell.odd && corner > 1 ? 5 - corner : corner;
  }

  TetMesh mesh;
  Eigen::Matrix3Xi surface;
  std::vector<int> cells;        ///< Of each tetrahedron.
  std::vector<int> vertices;     ///< Of each point.
  std::vector<int> number;       ///< Of each vertex of the tree; -1: none.
  std::vector<int> coarse_tets;  ///< Root of each tetrahedron.
  std::vector<MeshChange::Middle> middles;

 private:
  void addMiddleNodes(BisectionTree* tree);
};

/// From `old`, with the cells that were cut in `old_cut`, to `next`.
MeshChange changeBetween(const BisectionTree& tree, const Leaves& old, const Cut& old_cut,
                         const Leaves& next);

/// What a change of quadratic meshes has besides, after `tets` and `old_point`.
void addQuadraticChange(const BisectionTree& tree, const Leaves& old, const Leaves& next,
                        MeshChange* change);

}  // namespace palpate::mesh
