// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/passivity.h"

#include <algorithm>

#include "limits.h"

namespace palpate::haptics {
namespace {

constexpr double kStill = 0.015;  // [s] so long without a motion is rest

}  // namespace

PassivityController::PassivityController(const PassivitySettings& settings) : settings_(settings) {
  requireNotNegative("PassivityController", "max_damping", settings.max_damping);
  requireNotNegative("PassivityController", "velocity_smoothing", settings.velocity_smoothing);
}

// A device may report less often than forces are sent: what was sent since its last motion counts
// with its mean.
void PassivityController::observe(const Vec3& p, const Vec3& sent, double dt) {
  impulse_ += dt * sent;
  damping_impulse_ += dt * added_;
  time_ += dt;
  const Vec3 way = p - p_;
  if (way == Vec3::Zero()) {
    if (time_ > kStill) v_ -= dt / (dt + settings_.velocity_smoothing) * v_;
    return;
  }
  p_ = p;
  v_ += time_ / (time_ + settings_.velocity_smoothing) * (way / time_ - v_);
  out_ += impulse_.dot(way) / time_;
  dissipated_ -= damping_impulse_.dot(way) / time_;
  largest_ = std::max(largest_, out_);
  impulse_.setZero();
  damping_impulse_.setZero();
  time_ = 0.0;
}

Vec3 PassivityController::update(const Vec3& p, const Vec3& sent, const Vec3& force, double dt) {
  if (!begun_) p_ = p;
  begun_ = true;
  observe(p, sent, dt);
  damping_ = 0.0;
  added_.setZero();
  if (force == Vec3::Zero()) {
    // It touches nothing: what the tissue kept is no credit for the next touch.
    if (sent == Vec3::Zero()) out_ = 0.0;
    return added_;
  }
  const double v2 = v_.squaredNorm();
  if (out_ <= 0.0 || v2 == 0.0) return added_;
  damping_ = std::min(settings_.max_damping, out_ / (v2 * dt));
  added_ = -damping_ * v_;
  return added_;
}

}  // namespace palpate::haptics
