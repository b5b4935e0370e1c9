// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tet_builder.h"

namespace palpate::mesh {

/// Points and cells of a VTK unstructured grid as they lie in a file. Everything is double: no
/// index is too large for that.
struct VtkGrid {
  std::vector<double> points;        ///< x y z of each.
  std::vector<double> connectivity;  ///< Points of all cells, one after the other.
  std::vector<double> ends;          ///< Of each cell: where it ends in `connectivity`.
  std::vector<double> types;         ///< Of each cell.
  std::vector<double> region;        ///< Of each cell; empty if there is none.
};

/// Whether cell data of this name tells the region.
bool isRegionName(const std::string& name);

/// Adds the grid's points and tetrahedra.
/// @throws InputError in the name of `file`: index out of range, cells that do not fit their type,
/// volume cells that are no tetrahedra.
void addVtkGrid(const VtkGrid& grid, const std::string& file, TetBuilder* builder);

}  // namespace palpate::mesh
