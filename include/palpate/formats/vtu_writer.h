// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::formats {

/// Values at the points or cells of a mesh.
struct VtuArray {
  std::string name;        ///< As ParaView shows it; not empty.
  Eigen::MatrixXd values;  ///< components x count, one column per point or cell.
};

/// Writes a VTK XML unstructured grid (appended raw doubles), atomically. readTetMesh() reads
/// tetrahedra back exactly; regions are Int32 cell data "region".
///
/// @throws std::invalid_argument for another kind of cells than CellMesh names, a wrong number of
/// columns, or an empty name; InputError if the file cannot be written.
void writeVtu(const std::string& file, const mesh::CellMesh& mesh,
              const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data);
void writeVtu(const std::string& file, const mesh::TetMesh& mesh,
              const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data);

}  // namespace palpate::formats
