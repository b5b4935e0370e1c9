// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/hand_motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate::sim {
namespace {

constexpr double kTremor = 0.002, kTremorRate = 4.0;  // [m], [Hz]
constexpr double kSlide = 0.02, kSlideTime = 0.5;     // [m], [s]
constexpr double kTapRate = 2.0;                      // [Hz]
constexpr double kAside = 0.02;                       // [m]

}  // namespace

const std::vector<std::string>& HandMotion::names() {
  static const std::vector<std::string> kNames = {"press", "tremor", "slide", "taps", "wander"};
  return kNames;
}

HandMotion::HandMotion(const HandMotionSettings& settings) : settings_(settings) {
  if (std::find(names().begin(), names().end(), settings.motion) == names().end()) {
    throw std::invalid_argument("HandMotion: no motion " + settings.motion);
  }
  if (!(settings.speed > 0.0)) throw std::invalid_argument("HandMotion: speed must be > 0");
  down_ = (settings.above + settings.depth) / settings.speed;
}

HandIntent HandMotion::at(double t) {
  const double way = settings_.above + settings_.depth;
  HandIntent intent;
  if (settings_.motion == "wander") return wander(t);
  if (settings_.motion == "taps") {
    const double omega = 2.0 * M_PI * kTapRate;
    intent.position.z() = 0.5 * way * (std::cos(omega * t) - 1.0);
    intent.velocity.z() = -0.5 * way * omega * std::sin(omega * t);
    return intent;
  }
  intent.position.z() = -std::min(settings_.speed * t, way);
  if (t < down_) {
    intent.velocity.z() = -settings_.speed;
    return intent;
  }
  const double since = t - down_;
  if (settings_.motion == "tremor") {
    const double omega = 2.0 * M_PI * kTremorRate;
    intent.position.z() += kTremor * std::sin(omega * since);
    intent.velocity.z() = kTremor * omega * std::cos(omega * since);
  } else if (settings_.motion == "slide") {
    const double omega = M_PI / kSlideTime, phase = std::min(omega * since, M_PI);
    intent.position.x() = 0.5 * kSlide * (1.0 - std::cos(phase));
    intent.velocity.x() = 0.5 * kSlide * omega * std::sin(phase);
  }
  return intent;
}

HandIntent HandMotion::wander(double t) {
  std::uniform_real_distribution<double> pick(-1.0, 1.0);
  while (t >= begin_ + duration_) {
    begin_ += duration_;
    duration_ = 0.6 + 0.4 * pick(random_);
    from_ = to_;
    const double x = kAside * pick(random_), y = kAside * pick(random_);
    // From twice as far above the surface as below it to the depth.
    const double z = settings_.depth * (0.5 - 1.5 * pick(random_)) + settings_.above;
    to_ = Vec3(x, y, std::min(0.0, -z));
  }
  const double s = (t - begin_) / duration_;
  HandIntent intent;
  intent.position = from_ + s * s * (3.0 - 2.0 * s) * (to_ - from_);
  intent.velocity = 6.0 * s * (1.0 - s) / duration_ * (to_ - from_);
  return intent;
}

}  // namespace palpate::sim
