// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tet_builder.h"

namespace palpate::formats {

/// What a file says of each cell, under a name.
struct VtkArray {
  std::string name;
  std::size_t components;
  std::vector<double> values;  ///< Those of the first cell, of the second, ...
};

/// Points and cells of a VTK unstructured grid as they lie in a file. Everything is double: no
/// index is too large for that.
struct VtkGrid {
  std::vector<double> points;        ///< x y z of each.
  std::vector<double> connectivity;  ///< Points of all cells, one after the other.
  std::vector<double> ends;          ///< Of each cell: where it ends in `connectivity`.
  std::vector<double> types;         ///< Of each cell.
  std::vector<VtkArray> cell_data;
};

/// Adds the grid's points and tetrahedra with their cell data of one or three components. One
/// component named `region` or `gmsh:physical` tells the region.
/// @throws InputError in the name of `file`: index out of range, cells that do not fit their type,
/// volume cells that are no tetrahedra, cell data that is not as long as the cells, a region that
/// is no whole number.
void addVtkGrid(const VtkGrid& grid, const std::string& file, TetBuilder* builder);

}  // namespace palpate::formats
