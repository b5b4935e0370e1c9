// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/passivity.h"

#include <algorithm>

#include "limits.h"
#include "palpate/haptics/velocity_estimate.h"

namespace palpate::haptics {

PassivityController::PassivityController(const PassivitySettings& settings, double delay)
    : settings_(settings), delay_(std::min(delay, kLongestDelay)) {
  requireNotNegative("PassivityController", "max_damping", settings.max_damping);
  requireNotNegative("PassivityController", "delay", delay);
}

// Returns what was sent one delay ago, for ticks of variable length in a finite ring.
const PassivityController::Sent& PassivityController::delayed(const Sent& now) {
  const std::size_t size = under_way_.size();
  const auto forgetOldest = [&] {
    age_ -= under_way_[felt_].dt;
    felt_ = (felt_ + 1) % size;
  };
  newest_ = (newest_ + 1) % size;
  if (felt_ == newest_) forgetOldest();
  under_way_[newest_] = now;
  age_ += now.dt;
  while (felt_ != newest_ && age_ - under_way_[felt_].dt > delay_ + 0.5 * now.dt) forgetOldest();
  return under_way_[felt_];
}

// A device may report less often than forces are sent: the mean force since its last motion counts.
void PassivityController::observe(const Vec3& p, const Sent& sent) {
  impulse_ += sent.dt * sent.force;
  damping_impulse_ += sent.dt * sent.added;
  time_ += sent.dt;
  const Vec3 way = p - p_;
  if (way == Vec3::Zero()) return;
  p_ = p;
  if (time_ == 0.0) return;  // no force applied yet
  // A jump of the position does no work.
  if (!VelocityEstimate::leaps(way, time_)) {
    out_ += impulse_.dot(way) / time_;
    dissipated_ -= damping_impulse_.dot(way) / time_;
    largest_ = std::max(largest_, out_);
  }
  impulse_.setZero();
  damping_impulse_.setZero();
  time_ = 0.0;
}

Vec3 PassivityController::update(const Vec3& p, const Vec3& v, const Vec3& sent, const Vec3& force,
                                 double dt) {
  if (!begun_) p_ = p;
  begun_ = true;
  observe(p, delayed({sent, added_, dt}));
  damping_ = 0.0;
  added_.setZero();
  if (force == Vec3::Zero()) {
    // Without contact, dissipated energy is no credit for the next one.
    if (sent == Vec3::Zero()) out_ = 0.0;
    return added_;
  }
  const double v2 = v.squaredNorm();
  if (out_ <= 0.0 || v2 == 0.0) return added_;
  damping_ = std::min(settings_.max_damping, out_ / (v2 * dt));
  added_ = -damping_ * v;
  return added_;
}

}  // namespace palpate::haptics
