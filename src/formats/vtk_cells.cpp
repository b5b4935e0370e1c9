// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::formats {
namespace {

constexpr int kVtkTet4 = 10, kVtkTet10 = 24;
// Voxel, hexahedron, wedge, pyramid, prisms, their quadratic versions, polyhedron, Lagrange,
// Bezier.
constexpr int kOtherVtkCells[] = {11, 12, 13, 14, 15, 16, 25, 26, 27, 29, 31, 32,
                                  33, 37, 42, 71, 72, 73, 74, 78, 79, 80, 81};

bool isWhole(double value, double first, double end) {
  return value >= first && value < end && value == std::floor(value);
}

/// Refuses cell `i`, counted from 0.
[[noreturn]] void fail(const std::string& file, std::size_t i, const std::string& allowed) {
  throw InputError(file, "cell " + std::to_string(i + 1) + " (counted from 1)", "", allowed);
}

int numTetNodes(double type, const std::string& file, std::size_t i) {
  if (!isWhole(type, 0.0, 256.0)) {
    fail(file, i, "the type must be a whole number of 0 ... 255");
  }
  if (type == kVtkTet4) return 4;
  if (type == kVtkTet10) return 10;
  if (std::count(std::begin(kOtherVtkCells), std::end(kOtherVtkCells), type) > 0) {
    fail(file, i,
         "volume cells must be tetrahedra (type 10 or 24), this one has type " +
             std::to_string(static_cast<int>(type)));
  }
  return 0;
}

int regionOf(double value, const std::string& file, std::size_t i) {
  if (!isWhole(value, std::numeric_limits<int>::min(), std::numeric_limits<int>::max())) {
    fail(file, i, "the region must be a whole number");
  }
  return static_cast<int>(value);
}

bool tellsRegion(const VtkArray& array) {
  return array.components == 1 && (array.name == "region" || array.name == "gmsh:physical");
}

// Sets the data of cell `i` for the last tetrahedron.
void addCellData(const VtkGrid& grid, const std::string& file, std::size_t i, TetBuilder* builder) {
  for (const VtkArray& array : grid.cell_data) {
    if (array.components != 1 && array.components != 3) continue;
    const double* values = array.values.data() + i * array.components;
    if (tellsRegion(array)) builder->setRegion(regionOf(*values, file, i));
    builder->setData(array.name, static_cast<int>(array.components), values);
  }
}

void checkCellData(const VtkGrid& grid, const std::string& file) {
  for (const VtkArray& array : grid.cell_data) {
    if (array.values.size() == array.components * grid.types.size()) continue;
    throw InputError(file, "cell data " + array.name,
                     std::to_string(array.values.size() / array.components) + " values",
                     "there must be as many as cells, " + std::to_string(grid.types.size()));
  }
}

}  // namespace

void addVtkGrid(const VtkGrid& grid, const std::string& file, TetBuilder* builder) {
  checkCellData(grid, file);
  const auto first = static_cast<std::int64_t>(builder->numPoints());
  const std::size_t num_points = grid.points.size() / 3;
  for (std::size_t i = 0; i < num_points; ++i) {
    builder->addPoint(Vec3(grid.points.data() + 3 * i));
  }
  double begin = 0.0;
  for (std::size_t i = 0; i < grid.types.size(); ++i) {
    const double end = grid.ends[i];
    if (!isWhole(end, begin, static_cast<double>(grid.connectivity.size()) + 1.0)) {
      fail(file, i, "the offsets must grow, and end within the connectivity");
    }
    const int num_nodes = numTetNodes(grid.types[i], file, i);
    if (num_nodes > 0) {
      if (end - begin != num_nodes) {
        fail(file, i, "must have " + std::to_string(num_nodes) + " points by its type");
      }
      TetNodes nodes{};
      for (int k = 0; k < num_nodes; ++k) {
        const double node = grid.connectivity[static_cast<std::size_t>(begin) + k];
        if (!isWhole(node, 0.0, static_cast<double>(num_points))) {
          fail(file, i,
               "a point index is out of range; there are " + std::to_string(num_points) +
                   " points, counted from 0");
        }
        nodes[k] = first + static_cast<std::int64_t>(node);
      }
      builder->addTet(nodes, num_nodes);
      addCellData(grid, file, i, builder);
    }
    begin = end;
  }
}

}  // namespace palpate::formats
