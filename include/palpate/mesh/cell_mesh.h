// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Points and cells of one kind, for display of a body of any model.
struct CellMesh {
  Points points;  ///< 3 x n [m].
  /// k x m, a column a cell, in VTK order: k = 2 lines, 3 triangles, 4 tetrahedra, 8 hexahedra, 10
  /// quadratic tetrahedra.
  Eigen::MatrixXi cells;
  std::vector<int> region;  ///< Region of each cell; empty: all 0.
  /// Solid of each cell; empty: the first.
  std::vector<int> solid = {};

  Eigen::Index numPoints() const { return points.cols(); }
  Eigen::Index numCells() const { return cells.cols(); }
};

/// The points and tetrahedra of `mesh`, linear or quadratic.
CellMesh cellsOf(const TetMesh& mesh);

/// Edges of the cells as pairs of corners, without repetition, sorted.
std::vector<std::pair<int, int>> edgesOf(const CellMesh& mesh);

/// Mean edge length of the cells, each edge once [m]; 0 without cells.
double meanEdgeLength(const CellMesh& mesh);

}  // namespace palpate::mesh
