// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibrium of the particles, and checks of it.
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/base/number.h"
#include "sampled_tissue.h"

namespace palpate::tissue {
namespace {

constexpr int kMostAdaptations = 12;
constexpr int kMaxEquilibriumSteps = 200000;
constexpr double kSameRest = 0.01;  // change of the equilibrium by refinement, over the size [-]

}  // namespace

// Cycles without possible motion.
void SampledTissue::refuseTooManySubSteps(double dt) const {
  const double steps = std::ceil(dt / stableStep());
  if (steps <= kMostSubSteps) return;
  throw std::invalid_argument(
      "model sampled_elasticity: a cycle of solver.step = " + formatNumber(dt) + " s takes " +
      formatNumber(steps) + " sub-steps of " + formatNumber(stableStep()) + " s at rest, at most " +
      std::to_string(kMostSubSteps) +
      " are taken; choose a shorter step, coarser sampling, less damping, or tissue that is "
      "softer or heavier");
}

void SampledTissue::findEquilibrium() {
  for (int k = 0; k < kMostAdaptations; ++k) {
    if (!comeToRest()) {
      throw std::runtime_error("no equilibrium under gravity: it is too soft or too heavy");
    }
    if (!body_.adapt()) break;
  }
  body_.v.setZero();
  body_.save(&equilibrium_);
}

// Kinetic relaxation: velocities are zeroed at each maximum of the kinetic energy.
bool SampledTissue::comeToRest() {
  body_.v.setZero();
  Vec3 anchors;
  const double h = kSafety * body_.longestSteps().minCoeff();
  double kinetic = 0.0;
  for (int k = 0; k < kMaxEquilibriumSteps; ++k) {
    body_.umbrella().forces(body_.d, &forces_, &anchors);
    forces_ += gravity_ * body_.masses.transpose();
    if (forces_.norm() <= 0.01 * tolerance_) return true;
    body_.v += h * forces_ * body_.masses.cwiseInverse().asDiagonal();
    const double now = body_.v.colwise().squaredNorm().dot(body_.masses.transpose());
    if (now < kinetic) body_.v.setZero();
    kinetic = now < kinetic ? 0.0 : now;
    body_.d += h * body_.v;
  }
  return false;
}

// Coarsening needs less than `coarsen_below`, so refined particles may remain; a linear body still
// has one equilibrium.
void SampledTissue::endAtRest() {
  const Points x = x_;
  StateWriter parted;
  body_.save(&parted);
  StateReader equilibrium(equilibrium_.bytes());
  body_.restore(&equilibrium);
  body_.v.setZero();
  follow();
  if ((x_ - x).cwiseAbs().maxCoeff() <= kSameRest * size_) return;
  StateReader back(parted.bytes());
  body_.restore(&back);
  follow();
}

}  // namespace palpate::tissue
