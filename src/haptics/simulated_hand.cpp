// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/simulated_hand.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace palpate::haptics {
namespace {

constexpr double kSubstep = 1.0e-5;  // [s]

void check(const char* name, double value, bool zero_allowed) {
  if (std::isfinite(value) && (value > 0.0 || (zero_allowed && value == 0.0))) return;
  throw std::invalid_argument(std::string("SimulatedHand: ") + name + " = " +
                              std::to_string(value) + "; must be finite and " +
                              (zero_allowed ? ">= 0" : "> 0"));
}

}  // namespace

SimulatedHand::SimulatedHand(const HandSettings& settings, const Vec3& position)
    : settings_(settings), p_(position) {
  check("mass", settings.mass, false);
  check("device_damping", settings.device_damping, true);
  check("grip_stiffness", settings.grip_stiffness, true);
  check("grip_damping", settings.grip_damping, true);
  check("resolution", settings.resolution, true);
}

// Steps so short that the error of the symplectic Euler method is below that of the encoders.
void SimulatedHand::tick(const Vec3& meant, const Vec3& meant_v, const Vec3& force,
                         const Vec3& push, double dt) {
  const int steps = std::max(1, static_cast<int>(std::ceil(dt / kSubstep - 1e-9)));
  const double h = dt / steps;
  const HandSettings& s = settings_;
  for (int k = 0; k < steps; ++k) {
    const Vec3 goal = meant + (h * k) * meant_v;
    const Vec3 sum = s.grip_stiffness * (goal - p_) + s.grip_damping * (meant_v - v_) -
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
