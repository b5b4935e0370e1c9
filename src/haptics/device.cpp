// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/device.h"

#include <algorithm>

#include "limits.h"
#include "palpate/haptics/velocity_estimate.h"

namespace palpate::haptics {
namespace {

// Bound of K (delay + 0.1 tau)^2 / m for stability with lead() and any hand stiffness [-]: half of
// the least of 0.3 to 0.45, from roots of the sampled loop for delays of 1.5 to 21.5 ms.
constexpr double kPhase = 0.15;
constexpr double kDamperPhase = 0.5;

}  // namespace

DeviceLimits::DeviceLimits(const DeviceSettings& device, double tick) : device_(device) {
  requirePositive("DeviceLimits", "mass", device.mass);
  requireNotNegative("DeviceLimits", "damping", device.damping);
  requireNotNegative("DeviceLimits", "delay", device.delay);
  requirePositive("DeviceLimits", "rate", device.rate);
  requirePositive("DeviceLimits", "tick", tick);
  delay_ = device.delay + 1.5 * std::max(tick, 1.0 / device.rate);
}

double DeviceLimits::maxStiffness() const {
  const double late = delay_ + 0.1 * VelocityEstimate::kSmoothing;
  return std::max(0.5 * device_.damping / delay_, kPhase * device_.mass / (late * late));
}

double DeviceLimits::maxDamping() const {
  return kDamperPhase * device_.mass / (delay_ + VelocityEstimate::kSmoothing);
}

double DeviceLimits::lead(double K) const {
  if (K <= 0.0) return 0.0;
  const double lacking = 1.0 - device_.damping / (K * delay_);
  return delay_ * (1.0 + std::max(0.0, lacking));
}

}  // namespace palpate::haptics
