// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "bisection_tree.h"
#include "palpate/mesh/mesh_change.h"

namespace palpate::mesh {

/// Bisected cells of a tree, and the edges bisected by them.
struct Cut {
  std::vector<char> cells, edges;

  /// Resizes to the tree's size.
  void cover(const BisectionTree& tree);
  bool has(int cell) const { return cell < static_cast<int>(cells.size()) && cells[cell]; }
};

/// Calls visit(cell, root) for all existing cells below each root, parents first.
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

/// Mesh of the uncut cells in tree order. Points are in order of first use by tetrahedra, corners
/// before mid-edge nodes. A mid-edge node is the vertex that would bisect its edge.
struct Leaves {
  Leaves() = default;
  /// `quadratic`: with mid-edge nodes; vertices missing in `tree` are added.
  Leaves(BisectionTree* tree, int num_roots, const Cut& cut, bool quadratic);

  /// Whether no point hangs at an edge midpoint.
  bool conform(const BisectionTree& tree, const Cut& cut) const;
  /// Index of a vertex in this mesh, or -1.
  int find(int vertex) const {
    return vertex < static_cast<int>(number.size()) ? number[vertex] : -1;
  }
  /// Index of the cell's vertex that is corner `corner` of its tetrahedron.
  static int place(const BisectionTree::Cell& cell, int corner) {
    return cell.odd && corner > 1 ? 5 - corner : corner;
  }

  TetMesh mesh;
  Eigen::Matrix3Xi surface;
  std::vector<int> cells;        ///< Cell of each tetrahedron.
  std::vector<int> vertices;     ///< Vertex of each point.
  std::vector<int> number;       ///< Point of each vertex of the tree; -1: none.
  std::vector<int> coarse_tets;  ///< Root of each tetrahedron.
  std::vector<MeshChange::Middle> middles;

 private:
  void addMiddleNodes(BisectionTree* tree);
};

/// Change from `old`, with the cut cells `old_cut`, to `next`.
MeshChange changeBetween(const BisectionTree& tree, const Leaves& old, const Cut& old_cut,
                         const Leaves& next);

/// Adds the data of quadratic meshes. @pre `tets` and `old_point` are set.
void addQuadraticChange(const BisectionTree& tree, const Leaves& old, const Leaves& next,
                        MeshChange* change);

}  // namespace palpate::mesh
