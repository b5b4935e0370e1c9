// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_links.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

// Particles farther than this many sizes of the leaf at a point do not matter there.
constexpr double kReach = 2.2;

double kernel(double r) {
  const double s = std::max(0.0, 1.0 - r * r);
  return s * s;
}

}  // namespace

void SurfaceLinks::build(const Points& X, const ParticleTree& tree,
                         const std::vector<int>& leaves) {
  std::vector<int> at(tree.particles().size(), -1);
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    at[static_cast<std::size_t>(leaves[k])] = static_cast<int>(k);
  }
  start_.assign(1, 0);
  weights_.clear();
  std::vector<int> around;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Vec3 p = X.col(i);
    const int here = tree.leafAt(p);
    around = {here};
    for (const int n : tree.neighbours(here)) {
      around.push_back(n);
      for (const int m : tree.neighbours(n)) around.push_back(m);
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    const double reach = kReach * tree.particles()[static_cast<std::size_t>(here)].size;
    // [1, x - p] of each, weighted.
    Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
    const auto basis = [&](int n) {
      const Vec3 r = (tree.particles()[static_cast<std::size_t>(n)].X - p) / reach;
      return Eigen::Vector4d(1.0, r.x(), r.y(), r.z());
    };
    const auto weightOf = [&](int n) { return kernel(basis(n).tail<3>().norm()); };
    for (const int n : around) {
      const Eigen::Vector4d b = basis(n);
      moments += weightOf(n) * b * b.transpose();
    }
    moments.diagonal().tail<3>().array() += 1e-9 * moments(0, 0);  // all may lie in a plane
    const Eigen::Vector4d c = moments.ldlt().solve(Eigen::Vector4d::Unit(0));
    double sum = 0.0;
    for (const int n : around) sum += weightOf(n) * c.dot(basis(n));
    for (const int n : around) {
      const double weight = weightOf(n) * c.dot(basis(n)) / sum;
      if (weight != 0.0) weights_.push_back({at[static_cast<std::size_t>(n)], weight});
    }
    start_.push_back(static_cast<int>(weights_.size()));
  }
}

void SurfaceLinks::interpolate(const Points& of_leaves, Points* values) const {
  for (std::size_t i = 0; i + 1 < start_.size(); ++i) {
    Vec3 sum = Vec3::Zero();
    for (int k = start_[i]; k < start_[i + 1]; ++k) {
      const Weight& w = weights_[static_cast<std::size_t>(k)];
      sum += w.weight * of_leaves.col(w.leaf);
    }
    values->col(static_cast<Eigen::Index>(i)) = sum;
  }
}

void SurfaceLinks::addForces(const Points& on_points, Points* on_leaves) const {
  for (std::size_t i = 0; i + 1 < start_.size(); ++i) {
    const Vec3 force = on_points.col(static_cast<Eigen::Index>(i));
    if (force.isZero(0.0)) continue;
    for (int k = start_[i]; k < start_[i + 1]; ++k) {
      const Weight& w = weights_[static_cast<std::size_t>(k)];
      on_leaves->col(w.leaf) += w.weight * force;
    }
  }
}

void SurfaceLinks::addStiffness(const Eigen::VectorXd& of_points,
                                Eigen::VectorXd* of_leaves) const {
  for (std::size_t i = 0; i + 1 < start_.size(); ++i) {
    double sum = 0.0;
    for (int k = start_[i]; k < start_[i + 1]; ++k) {
      sum += std::abs(weights_[static_cast<std::size_t>(k)].weight);
    }
    for (int k = start_[i]; k < start_[i + 1]; ++k) {
      const Weight& w = weights_[static_cast<std::size_t>(k)];
      (*of_leaves)[w.leaf] += of_points[static_cast<Eigen::Index>(i)] * std::abs(w.weight) * sum;
    }
  }
}

}  // namespace palpate::tissue
