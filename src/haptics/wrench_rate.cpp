// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/wrench_rate.h"

#include <algorithm>
#include <cmath>

#include "limits.h"

namespace palpate::haptics {

WrenchRate::WrenchRate(const WrenchFilterSettings& settings)
    : max_force_rate_(settings.max_force_rate),
      max_torque_rate_(settings.max_torque_rate),
      max_step_(settings.max_step) {
  requirePositive("WrenchRate", "max_force_rate", max_force_rate_);
  requirePositive("WrenchRate", "max_torque_rate", max_torque_rate_);
  requirePositive("WrenchRate", "max_step", max_step_);
}

const Wrench& WrenchRate::follow(const Wrench& goal, double dt) {
  if (!std::isfinite(dt) || dt <= 0.0) return output_;
  dt = std::min(dt, max_step_);
  output_.force = approached(output_.force, goal.force, max_force_rate_ * dt);
  output_.torque = approached(output_.torque, goal.torque, max_torque_rate_ * dt);
  return output_;
}

}  // namespace palpate::haptics
