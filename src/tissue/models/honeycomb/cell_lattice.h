// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::tissue {

/// Equal box-shaped cells on a grid along the axes of a frame O.
struct CellLattice {
  struct Cell {
    Eigen::Vector3i at;          ///< Grid indices.
    std::array<int, 6> sides;    ///< 2 a: on the negative side of axis a, 2 a + 1: on the positive.
    std::array<int, 8> corners;  ///< Bit a of the index: on the positive side of axis a.
  };
  struct Side {
    int axis;                    ///< Axis of the normal.
    std::array<int, 2> cells;    ///< Cells before and behind along the axis; -1: none.
    std::array<int, 4> corners;  ///< Counterclockwise seen from the positive side.
  };

  Vec3 size;                   ///< Size of a cell [m].
  Points corners;              ///< Rest positions in O, 3 x n [m], x fastest.
  std::vector<Cell> cells;     ///< x fastest.
  std::vector<Side> sides;     ///< In the order of the cells.
  Eigen::Matrix3Xi triangles;  ///< Two triangles of each outer side, outward: indices of corners.

  int numCells() const { return static_cast<int>(cells.size()); }
  int numSides() const { return static_cast<int>(sides.size()); }
  /// Volume of a cell at rest [m^3].
  double volume() const { return size.prod(); }
  /// The cell behind side k of a cell, or -1.
  int neighbour(int cell, int k) const {
    return sides[static_cast<std::size_t>(
                     cells[static_cast<std::size_t>(cell)].sides[static_cast<std::size_t>(k)])]
        .cells[static_cast<std::size_t>(k % 2)];
  }
  /// Centre of a cell at rest in O [m].
  Vec3 centre(int cell) const;
  /// 8 x m, corners of the cells in VTK's order of hexahedra.
  Eigen::MatrixXi hexahedra() const;
};

/// Makes the `inside` cells of a grid of `count` cells of `size` [m] from `low` [m]; x fastest.
CellLattice makeCellLattice(const Vec3& low, const Vec3& size, const Eigen::Vector3i& count,
                            const std::vector<bool>& inside);

}  // namespace palpate::tissue
