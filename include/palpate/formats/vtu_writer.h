// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::formats {

/// Values on the points or the cells of a mesh.
struct VtuArray {
  std::string name;        ///< As ParaView shows it; not empty.
  Eigen::MatrixXd values;  ///< components x count, one column a point or a cell.
};

/// Writes a VTK XML unstructured grid (appended raw doubles) that ParaView opens and readTetMesh()
/// gives back bit for bit if its cells are tetrahedra, regions as Int32 cell data "region". The
/// file appears whole or not at all.
///
/// @throws std::invalid_argument for cells of a kind that CellMesh does not name, if an array's
/// columns are not as many as points or cells, or its name is empty; InputError if the file cannot
/// be written.
void writeVtu(const std::string& file, const mesh::CellMesh& mesh,
              const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data);
void writeVtu(const std::string& file, const mesh::TetMesh& mesh,
              const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data);

}  // namespace palpate::formats
