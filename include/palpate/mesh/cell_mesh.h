// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Points and cells of one kind between them, for whoever shows a body without knowing what it is
/// made of.
struct CellMesh {
  Points points;  ///< 3 x n [m].
  /// k x m, a column a cell, in VTK order: k = 2 lines, 3 triangles, 4 tetrahedra, 8 hexahedra, 10
  /// quadratic tetrahedra.
  Eigen::MatrixXi cells;
  std::vector<int> region;  ///< One tag a cell, or empty: all in region 0.
  /// Of each cell which of the body's solids it is made of, or empty: of the first.
  std::vector<int> solid = {};

  Eigen::Index numPoints() const { return points.cols(); }
  Eigen::Index numCells() const { return cells.cols(); }
};

/// The points and tetrahedra of `mesh`, linear or quadratic.
CellMesh cellsOf(const TetMesh& mesh);

/// The pairs of corners that cells connect, each once, sorted.
std::vector<std::pair<int, int>> edgesOf(const CellMesh& mesh);

/// Of the straight lines between the corners of cells, each once [m]; 0 without cells.
double meanEdgeLength(const CellMesh& mesh);

}  // namespace palpate::mesh
