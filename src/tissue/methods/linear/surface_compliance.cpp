// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_compliance.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace palpate::tissue {
namespace {

// Right-hand sides per solve.
constexpr int kColumns = 48;

}  // namespace

SurfaceCompliance::SurfaceCompliance(fem::Elasticity* elasticity, const fem::FreeMask& free,
                                     const Points& X, const Eigen::Matrix3Xi& triangles,
                                     const BodySurroundings* surroundings)
    : position_(static_cast<std::size_t>(X.cols()), -1),
      free_(free),
      stiffness_(elasticity->makeMatrix()) {
  std::vector<fem::HeldDirection> held_by_springs;
  if (surroundings) held_by_springs = surroundings->heldDirections();
  const std::string motions = fem::freeRigidMotions(X, free, held_by_springs);
  if (!motions.empty()) {
    throw std::invalid_argument(
        "method linear_precomputed needs a body that its supports hold, "
        "they leave " +
        motions);
  }
  for (Eigen::Index k = 0; k < triangles.size(); ++k) {
    const int node = triangles.data()[k];
    if (position_[node] >= 0 || free.col(node).isZero()) continue;
    position_[node] = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
  }
  if (nodes_.size() > kMaxComplianceNodes) {
    throw std::invalid_argument(
        "the surface has " + std::to_string(nodes_.size()) +
        " nodes that can move: method linear_precomputed keeps a dense matrix of at most " +
        std::to_string(kMaxComplianceNodes) +
        " (288 MB); enlarge edge_length, hold more of the body, or choose implicit_pcg");
  }
  elasticity->hessian(X, fem::Tangent::kExact, &stiffness_);
  if (surroundings) {
    for (const fem::EnergyTerm* term : surroundings->terms()) {
      term->addHessian(X, fem::Tangent::kExact, &stiffness_);
    }
  }
  fem::Stiffness held = stiffness_;
  held.constrain(free);
  factor_ = std::make_unique<solver::StiffnessFactor>(held);
  condense(free);
}

void SurfaceCompliance::condense(const fem::FreeMask& free) {
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(nodes_.size());
  matrix_.setZero(size, size);
  for (Eigen::Index begin = 0; begin < size; begin += kColumns) {
    const Eigen::Index count = std::min<Eigen::Index>(kColumns, size - begin);
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(free.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const int node = nodes_[(begin + k) / 3];
      const Eigen::Index component = (begin + k) % 3;
      unit(3 * node + component, k) = free(component, node);
    }
    const Eigen::MatrixXd column = factor_->solve(unit);
    for (std::size_t a = 0; a < nodes_.size(); ++a) {
      matrix_.block(3 * static_cast<Eigen::Index>(a), begin, 3, count) =
          column.middleRows(3 * nodes_[a], 3);
    }
  }
}

void SurfaceCompliance::solve(const Points& f, Points* u) const {
  const Points right = f.cwiseProduct(free_);
  const Eigen::MatrixXd solution =
      factor_->solve(Eigen::Map<const Eigen::VectorXd>(right.data(), right.size()));
  *u = Eigen::Map<const Points>(solution.data(), 3, f.cols());
}

}  // namespace palpate::tissue
