// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/cell_mesh.h"

#include <algorithm>

namespace palpate::mesh {

CellMesh cellsOf(const TetMesh& mesh) {
  CellMesh all;
  all.points = mesh.points;
  all.cells.resize(mesh.quadratic() ? 10 : 4, mesh.numTets());
  all.cells.topRows(4) = mesh.tets;
  if (mesh.quadratic()) all.cells.bottomRows(6) = mesh.midnodes;
  all.region = mesh.region;
  return all;
}

std::vector<std::pair<int, int>> edgesOf(const CellMesh& mesh) {
  const bool hexahedra = mesh.cells.rows() == 8;
  const Eigen::Index corners = hexahedra ? 0 : std::min<Eigen::Index>(mesh.cells.rows(), 4);
  std::vector<std::pair<int, int>> edges;
  for (Eigen::Index cell = 0; cell < mesh.numCells(); ++cell) {
    for (int a = 0; hexahedra && a < 4; ++a) {
      const int next = (a + 1) % 4;
      edges.push_back(std::minmax({mesh.cells(a, cell), mesh.cells(next, cell)}));
      edges.push_back(std::minmax({mesh.cells(4 + a, cell), mesh.cells(4 + next, cell)}));
      edges.push_back(std::minmax({mesh.cells(a, cell), mesh.cells(4 + a, cell)}));
    }
    for (Eigen::Index a = 0; a < corners; ++a) {
      for (Eigen::Index b = a + 1; b < corners; ++b) {
        edges.push_back(std::minmax({mesh.cells(a, cell), mesh.cells(b, cell)}));
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

double meanEdgeLength(const CellMesh& mesh) {
  const std::vector<std::pair<int, int>> edges = edgesOf(mesh);
  if (edges.empty()) return 0.0;
  double sum = 0.0;
  for (const auto& [i, j] : edges) sum += (mesh.points.col(i) - mesh.points.col(j)).norm();
  return sum / static_cast<double>(edges.size());
}

}  // namespace palpate::mesh
