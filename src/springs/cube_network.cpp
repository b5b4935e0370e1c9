// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <stdexcept>
#include <utility>

#include "palpate/springs/spring_grids.h"

namespace palpate::springs {
namespace {

Eigen::Vector3i corner(int k) { return {k & 1, (k >> 1) & 1, (k >> 2) & 1}; }

struct Part {
  double stiffness = 0.0;
  SpringKind kind = SpringKind::kEdge;
};

// Contribution of one cube to the spring between two of its corners.
Part share(const CubeSprings& springs, int k, int l) {
  switch ((corner(k) - corner(l)).cwiseAbs().sum()) {
    case 1:
      return {0.25 * springs.edge, SpringKind::kEdge};
    case 2:
      return {0.5 * springs.face_diagonal, SpringKind::kFaceDiagonal};
    default:
      return {springs.body_diagonal, SpringKind::kBodyDiagonal};
  }
}

}  // namespace

SpringNetwork cubeNetwork(const CubeSprings& springs, double edge, const Eigen::Vector3i& cells,
                          double density) {
  requirePositive("edge", edge);
  requirePositive("density", density);
  if (cells.minCoeff() < 1) throw std::invalid_argument("cells must be >= 1 along each axis");
  const Eigen::Vector3i nodes = cells + Eigen::Vector3i::Ones();
  const auto index = [&](const Eigen::Vector3i& p) {
    return p.x() + nodes.x() * (p.y() + nodes.y() * p.z());
  };
  SpringNetwork network;
  network.points.resize(3, nodes.cast<Eigen::Index>().prod());
  network.masses = Eigen::VectorXd::Zero(network.points.cols());
  for (int z = 0; z < nodes.z(); ++z) {
    for (int y = 0; y < nodes.y(); ++y) {
      for (int x = 0; x < nodes.x(); ++x) {
        network.points.col(index({x, y, z})) = edge * Vec3(x, y, z);
      }
    }
  }
  std::map<std::pair<int, int>, Part> parts;
  for (int z = 0; z < cells.z(); ++z) {
    for (int y = 0; y < cells.y(); ++y) {
      for (int x = 0; x < cells.x(); ++x) {
        const Eigen::Vector3i cell(x, y, z);
        for (int k = 0; k < 8; ++k) {
          const int a = index(cell + corner(k));
          network.masses[a] += 0.125 * density * edge * edge * edge;
          for (int l = k + 1; l < 8; ++l) {
            const int b = index(cell + corner(l));
            Part& part = parts[{std::min(a, b), std::max(a, b)}];
            const Part added = share(springs, k, l);
            part = {part.stiffness + added.stiffness, added.kind};
          }
        }
      }
    }
  }
  for (const auto& [ends, part] : parts) {
    if (part.stiffness == 0.0) continue;
    const double length = (network.points.col(ends.second) - network.points.col(ends.first)).norm();
    network.springs.push_back(
        {ends.first, ends.second, part.stiffness, 0.0, 0.0, length, part.kind});
  }
  return network;
}

}  // namespace palpate::springs
