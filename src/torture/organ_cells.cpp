// SPDX-License-Identifier: GPL-3.0-or-later
#include "organ_cells.h"

#include <algorithm>
#include <limits>

namespace palpate::torture {

const mesh::CellMesh& OrganCells::of(const sim::Simulator& simulator, int organ) {
  kept_.resize(static_cast<std::size_t>(simulator.numOrgans()));
  Kept& kept = kept_[static_cast<std::size_t>(organ)];
  const std::uint64_t revision = simulator.shape(organ).revision;
  if (!kept.made || kept.revision != revision) {
    kept = {simulator.cells(organ), revision, true};
  }
  return kept.cells;
}

bool areLinearTets(const mesh::CellMesh& cells) {
  return cells.cells.rows() == 4 && cells.cells.cols() > 0;
}

double leastVolumeRatio(const mesh::CellMesh& rest, const Points& now) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < rest.numCells(); ++t) {
    const Eigen::Vector4i tet = rest.cells.col(t);
    least = std::min(least, mesh::signedVolume(now, tet) / mesh::signedVolume(rest.points, tet));
  }
  return least;
}

}  // namespace palpate::torture
