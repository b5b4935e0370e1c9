// SPDX-License-Identifier: GPL-3.0-or-later
#include "canonical_order.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "palpate/mesh/hilbert_order.h"

namespace palpate::mesh {
void orderCanonically(TetMesh* mesh) {
  if (mesh->numPoints() == 0) return;
  const std::vector<int> order = hilbertOrder(mesh->points);
  std::vector<int> renamed(order.size());
  Points points(3, mesh->numPoints());
  for (std::size_t k = 0; k < order.size(); ++k) {
    renamed[order[k]] = static_cast<int>(k);
    points.col(k) = mesh->points.col(order[k]);
  }
  mesh->points = std::move(points);

  std::vector<std::array<int, 4>> tets(mesh->numTets());
  for (Eigen::Index t = 0; t < mesh->numTets(); ++t) {
    std::array<int, 4>& v = tets[t];
    for (int c = 0; c < 4; ++c) v[c] = renamed[mesh->tets(c, t)];
    std::sort(v.begin(), v.end());
    if (signedVolume(mesh->points, {v[0], v[1], v[2], v[3]}) < 0.0) std::swap(v[2], v[3]);
  }
  std::sort(tets.begin(), tets.end());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    mesh->tets.col(t) = Eigen::Vector4i(tets[t][0], tets[t][1], tets[t][2], tets[t][3]);
  }
}

}  // namespace palpate::mesh
