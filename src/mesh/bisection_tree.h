// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Index of the edge between two vertices of a cell, see BisectionTree::Cell::edge.
constexpr int kEdgeOf[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};
/// Corners at the ends of each mid-edge node of a quadratic tetrahedron, see TetMesh::midnodes.
constexpr std::array<std::array<int, 2>, 6> kMiddlesBetween = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Tetrahedra of a mesh and their bisections, as binary trees that grow on demand. A tetrahedron is
/// cut at the midpoint of its longest edge [Rivara 1991, "Local modification of meshes for adaptive
/// and/or multigrid finite-element methods"]. Cells that share a face agree on its longest edge, so
/// cutting until no edge midpoint hangs ends with a conforming mesh. Shapes stay bounded in
/// practice [Hannukainen, Korotov, Krizek 2014, "On numerical regularity of the face-to-face
/// longest-edge bisection algorithm for tetrahedral partitions"], and are better than those of
/// marked bisection, for which bounds are proven.
class BisectionTree {
 public:
  struct Vertex {
    int a = -1, b = -1;  ///< Ends of the edge with this midpoint; -1: coarse mesh.
    int depth = 0;       ///< 1 + the larger depth of a and b.
  };
  struct Edge {
    int a, b;                ///< a < b.
    int middle = -1;         ///< Midpoint vertex; -1: not bisected.
    std::vector<int> cells;  ///< All cells with this edge.
  };
  struct Cell {
    std::array<int, 4> vertex;    ///< The first two are the longest edge, to be bisected.
    std::array<int, 6> edge;      ///< 01 02 03 12 13 23.
    int parent = -1, child = -1;  ///< First child, followed by the second; -1: none yet.
    std::uint8_t boundary;        ///< Bit k: the face opposite vertex k is on the boundary.
    bool odd;                     ///< The volume is positive with the last two exchanged.
  };

  /// The tetrahedra of `mesh` are the first cells. Mid-edge nodes count as midpoints of straight
  /// edges.
  explicit BisectionTree(const TetMesh& mesh);

  const Vertex& vertex(int v) const { return vertices_[v]; }
  const Vec3& rest(int v) const { return rest_[v]; }  ///< [m]
  const Edge& edge(int e) const { return edges_[e]; }
  const Cell& cell(int c) const { return cells_[c]; }
  int numVertices() const { return static_cast<int>(vertices_.size()); }
  int numEdges() const { return static_cast<int>(edges_.size()); }
  int numCells() const { return static_cast<int>(cells_.size()); }
  double volume(int c) const { return volume_[c]; }  ///< At rest [m^3].
  double longestEdge(int c) const {                  ///< At rest [m].
    return (rest_[cells_[c].vertex[0]] - rest_[cells_[c].vertex[1]]).norm();
  }

  /// Makes the children of a cell. @pre it has none.
  void bisect(int c);
  /// Midpoint vertex of an edge, made if missing.
  int middleOf(int edge);

 private:
  int edgeBetween(int a, int b);
  std::array<double, 4> rank(int a, int b) const;
  void order(Cell* cell) const;
  void addCell(Cell cell, double volume);
  void addChild(int parent, int lost, int middle);

  std::vector<Vertex> vertices_;
  std::vector<Vec3> rest_;
  std::vector<Edge> edges_;
  std::vector<Cell> cells_;
  std::vector<double> volume_;
  std::unordered_map<std::uint64_t, int> edge_number_;
};

}  // namespace palpate::mesh
