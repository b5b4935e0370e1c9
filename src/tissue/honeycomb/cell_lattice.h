// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::tissue {

/// Box-shaped cells, all of one size, side by side on a grid along the axes of a frame O.
struct CellLattice {
  struct Cell {
    Eigen::Vector3i at;          ///< On the grid.
    std::array<int, 6> sides;    ///< 2 a: on the negative side of axis a, 2 a + 1: on the positive.
    std::array<int, 8> corners;  ///< Bit a of the index: on the positive side of axis a.
  };
  struct Side {
    int axis;                    ///< Of its normal.
    std::array<int, 2> cells;    ///< Before and behind it along the axis; -1: none.
    std::array<int, 4> corners;  ///< Counterclockwise seen from the positive side.
  };

  Vec3 size;                   ///< Of a cell [m].
  Points corners;              ///< At rest in O, 3 x n [m], x fastest.
  std::vector<Cell> cells;     ///< x fastest.
  std::vector<Side> sides;     ///< In the order in which cells come to them.
  Eigen::Matrix3Xi triangles;  ///< Two of each outer side, outward, into corners.

  int numCells() const { return static_cast<int>(cells.size()); }
  int numSides() const { return static_cast<int>(sides.size()); }
  /// Of a cell at rest [m^3].
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

/// The cells of a grid of `count` cells of `size` [m] from `low` [m] of which `inside`, one a cell,
/// x fastest, says so.
CellLattice makeCellLattice(const Vec3& low, const Vec3& size, const Eigen::Vector3i& count,
                            const std::vector<bool>& inside);

}  // namespace palpate::tissue
