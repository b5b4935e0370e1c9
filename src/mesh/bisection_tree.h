// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Number of the edge between two vertices of a cell, see BisectionTree::Cell::edge.
constexpr int kEdgeOf[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};
/// Corners that the middle nodes of a quadratic tetrahedron are between, see TetMesh::midnodes.
constexpr std::array<std::array<int, 2>, 6> kMiddlesBetween = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// The tetrahedra that bisection makes of a mesh, as binary trees that grow where they are asked
/// for. A tetrahedron is cut at the middle of its longest edge [Rivara 1991, "Local modification of
/// meshes for adaptive and/or multigrid finite-element methods"]. All that share a face find the
/// same longest edge in it, so that cutting on wherever an edge of a cell is cut ends with a mesh
/// that conforms. Shapes stay bounded in practice [Hannukainen, Korotov, Krizek 2014, "On numerical
/// regularity of the face-to-face longest-edge bisection algorithm for tetrahedral partitions"],
/// and are better ones than those of bisection by marks, for which there is a proof.
class BisectionTree {
 public:
  struct Vertex {
    int a = -1, b = -1;  ///< It is in the middle between these; -1: of the coarse mesh.
    int depth = 0;       ///< One more than that of the deeper one of both.
  };
  struct Edge {
    int a, b;                ///< a < b.
    int middle = -1;         ///< Vertex; -1 as long as nobody bisected it.
    std::vector<int> cells;  ///< All that have it.
  };
  struct Cell {
    std::array<int, 4> vertex;    ///< The longest edge, between the first two, is bisected.
    std::array<int, 6> edge;      ///< 01 02 03 12 13 23.
    int parent = -1, child = -1;  ///< The second child follows the first; -1: not yet made.
    std::uint8_t boundary;        ///< Bit k: the face opposite vertex k is on the boundary.
    bool odd;                     ///< Positive if the last two vertices change places.
  };

  /// The points of `mesh`; its tetrahedra are the first cells. Middle nodes are the middles of its
  /// edges, as if these were straight.
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

  /// Makes the children of a cell that has none.
  void bisect(int c);
  /// The vertex in the middle of an edge, made where there is none.
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
