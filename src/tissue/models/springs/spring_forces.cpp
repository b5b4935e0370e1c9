// SPDX-License-Identifier: GPL-3.0-or-later
#include "spring_forces.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "palpate/springs/step_bound.h"

namespace palpate::tissue {
namespace {

// Of a spring that pulls by `force` at the distance `u`: how it resists motion along and across.
Mat3 tangentOf(const Vec3& way, double u, double stiffness, double force, bool projected) {
  const Vec3 n = way / u;
  double along = stiffness, across = force / u;
  if (projected) across = std::max(across, 0.0);
  return (along - across) * n * n.transpose() + across * Mat3::Identity();
}

const springs::SpringNetwork& checked(const springs::SpringNetwork& network, Eigen::Index points) {
  springs::checkNetwork(network);
  if (network.points.cols() != points) {
    throw std::invalid_argument("springs between " + std::to_string(network.points.cols()) +
                                " points; the mesh has " + std::to_string(points));
  }
  return network;
}

}  // namespace

SpringForces::SpringForces(const springs::SpringNetwork& network, Eigen::Index num_points)
    : num_points_(static_cast<int>(num_points)),
      springs_(checked(network, num_points)),
      largest_square_(std::pow(2.0 / springs::largestStep(network), 2)) {}

fem::Stiffness SpringForces::makeMatrix() const {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(static_cast<std::size_t>(springs_.size()));
  for (int s = 0; s < springs_.size(); ++s) pairs.emplace_back(springs_.a(s), springs_.b(s));
  return fem::Stiffness(fem::BlockMatrix(num_points_, pairs));
}

double SpringForces::gradient(const Points& x, Points* g) const {
  g->setZero(3, x.cols());
  return springs_.addGradient(x, g);
}

void SpringForces::hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const {
  K->setZero();
  fem::BlockMatrix& blocks = K->blocks();
  for (int s = 0; s < springs_.size(); ++s) {
    const int a = springs_.a(s), b = springs_.b(s);
    const Vec3 way = x.col(b) - x.col(a);
    const double u = way.norm();
    if (!(u > 0.0)) continue;
    const Mat3 H = tangentOf(way, u, springs_.stiffness(s), springs_.force(s, u),
                             tangent == fem::Tangent::kProjected);
    blocks.block(blocks.diagonal(a)) += H;
    blocks.block(blocks.diagonal(b)) += H;
    const int slot = blocks.find(a, b);
    blocks.block(slot) -= H;
    blocks.block(blocks.transposed(slot)) -= H;
  }
}

}  // namespace palpate::tissue
