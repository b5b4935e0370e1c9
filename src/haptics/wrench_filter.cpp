// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/wrench_filter.h"

#include <algorithm>
#include <cmath>

#include "limits.h"

namespace palpate::haptics {

WrenchFilter::WrenchFilter(const WrenchFilterSettings& settings)
    : settings_(settings), fade_(settings.ramp, 0.0) {
  requirePositive("WrenchFilter", "max_force", settings.max_force);
  requirePositive("WrenchFilter", "max_torque", settings.max_torque);
  requirePositive("WrenchFilter", "max_force_rate", settings.max_force_rate);
  requirePositive("WrenchFilter", "max_torque_rate", settings.max_torque_rate);
  requireNotNegative("WrenchFilter", "ramp", settings.ramp);
  requireNotNegative("WrenchFilter", "smoothing", settings.smoothing);
  requirePositive("WrenchFilter", "max_step", settings.max_step);
}

const Wrench& WrenchFilter::update(const Wrench& target, bool live, double dt) {
  if (!std::isfinite(dt) || dt <= 0.0) return output_;
  dt = std::min(dt, settings_.max_step);

  live = live && target.allFinite();
  if (live) {
    const Wrench goal{clamped(target.force, settings_.max_force),
                      clamped(target.torque, settings_.max_torque)};
    // After a full fade the low-pass restarts.
    const bool fresh = fade_.gain() == 0.0 || settings_.smoothing == 0.0;
    const double share = fresh ? 1.0 : 1.0 - std::exp(-dt / settings_.smoothing);
    smooth_.force += share * (goal.force - smooth_.force);
    smooth_.torque += share * (goal.torque - smooth_.torque);
  }
  const Wrench faded = fade_.update(smooth_, live, dt);

  output_.force = clamped(approached(output_.force, faded.force, settings_.max_force_rate * dt),
                          settings_.max_force);
  output_.torque = clamped(approached(output_.torque, faded.torque, settings_.max_torque_rate * dt),
                           settings_.max_torque);
  return output_;
}

void WrenchFilter::reset() {
  smooth_ = output_ = Wrench();
  fade_ = WrenchFade(settings_.ramp, 0.0);
}

}  // namespace palpate::haptics
