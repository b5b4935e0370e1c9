// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tet_builder.h"

namespace palpate::formats {

/// Named cell data of a file.
struct VtkArray {
  std::string name;
  std::size_t components;
  std::vector<double> values;  ///< Cell after cell.
};

/// Points and cells of a VTK unstructured grid as in the file, as doubles, which hold all indices.
struct VtkGrid {
  std::vector<double> points;        ///< x y z of each point.
  std::vector<double> connectivity;  ///< Points of all cells, concatenated.
  std::vector<double> ends;          ///< End of each cell in `connectivity`.
  std::vector<double> types;         ///< VTK type of each cell.
  std::vector<VtkArray> cell_data;
};

/// Adds the points and tetrahedra, with cell data of one or three components. A component named
/// `region` or `gmsh:physical` is the region.
/// @throws InputError naming `file`: index out of range, cells that do not fit their type, other
/// volume cells, cell data of another length, a region that is not an integer.
void addVtkGrid(const VtkGrid& grid, const std::string& file, TetBuilder* builder);

}  // namespace palpate::formats
