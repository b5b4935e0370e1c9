// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/simulated_hand.h"

#include <algorithm>
#include <cmath>

#include "limits.h"

namespace palpate::haptics {
namespace {

constexpr double kSubstep = 1.0e-5;  // [s]

}  // namespace

SimulatedHand::SimulatedHand(const HandSettings& settings, const Vec3& position)
    : settings_(settings), p_(position) {
  requirePositive("SimulatedHand", "mass", settings.mass);
  requireNotNegative("SimulatedHand", "device_damping", settings.device_damping);
  requireNotNegative("SimulatedHand", "grip_stiffness", settings.grip_stiffness);
  requireNotNegative("SimulatedHand", "grip_damping", settings.grip_damping);
  requireNotNegative("SimulatedHand", "resolution", settings.resolution);
  requireNotNegative("SimulatedHand", "guide_stiffness", settings.guide_stiffness);
  requireNotNegative("SimulatedHand", "guide_damping", settings.guide_damping);
}

// Sub-steps for which the error of symplectic Euler is below the encoders' resolution.
void SimulatedHand::tick(const Vec3& meant, const Vec3& meant_v, const Vec3& force,
                         const Vec3& push, double dt) {
  const int steps = std::max(1, static_cast<int>(std::ceil(dt / kSubstep - 1e-9)));
  const double h = dt / steps;
  const HandSettings& s = settings_;
  const double k_side = s.grip_stiffness + s.guide_stiffness;
  const double b_side = s.grip_damping + s.guide_damping;
  const Vec3 K(k_side, k_side, s.grip_stiffness), B(b_side, b_side, s.grip_damping);
  for (int k = 0; k < steps; ++k) {
    const Vec3 goal = meant + (h * k) * meant_v;
    const Vec3 sum = K.cwiseProduct(goal - p_) + B.cwiseProduct(meant_v - v_) -
                     s.device_damping * v_ + force + push;
    v_ += (h / s.mass) * sum;
    p_ += h * v_;
  }
}

Vec3 SimulatedHand::measured() const {
  const double r = settings_.resolution;
  if (r == 0.0) return p_;
  return p_.unaryExpr([r](double x) { return r * std::round(x / r); });
}

}  // namespace palpate::haptics
