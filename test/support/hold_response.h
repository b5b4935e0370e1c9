// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "palpate/contact/response.h"

namespace palpate::test {

/// A bilateral response with a memory, as small as can be: what was inside an obstacle at the end
/// of a step is held by a spring from then on, in every direction, wherever it is in a step that
/// begins less than 20 mm away.
/// Before that it is pushed out along the normal.
class HoldResponse final : public contact::Response {
 public:
  explicit HoldResponse(double stiffness) : stiffness_(stiffness) {}

  double reach() const override { return 0.02; }
  bool clings(int number, int first, int last) const override {
    for (const auto& [key, stretch_G] : held_) {
      if (key.second == number && first <= key.first && key.first <= last) return true;
    }
    return false;
  }
  bool active(const contact::Touch& touch) const override {
    return touch.gap < 0.0 || held(touch) != held_.end();
  }
  bool followsMotion() const override { return true; }

  double energy(const contact::Touch& touch) const override {
    return 0.5 * touch.area * stiffness_ * stretch(touch).squaredNorm();
  }
  contact::TouchForce force(const contact::Touch& touch) const override {
    // What is pushed out feels the gradient of gap^2 / 2, whose length may be less than the gap.
    const double steepness = held(touch) == held_.end() ? touch.steepness : 1.0;
    return {0.0, steepness * touch.area * stiffness_ * stretch(touch)};
  }
  Mat3 stiffness(const contact::Touch& touch, fem::Tangent tangent) const override {
    const double k = touch.area * stiffness_;
    if (held(touch) != held_.end()) return k * Mat3::Identity();
    if (!(touch.gap < 0.0)) return Mat3::Zero();
    Mat3 H_G = touch.steepness * touch.steepness * touch.normal_G * touch.normal_G.transpose();
    if (tangent == fem::Tangent::kExact) H_G += touch.gap * touch.curvature_G;
    return k * touch.R_WG * H_G * touch.R_WG.transpose();
  }

  bool remembers() const override { return true; }
  void endStep(const std::vector<contact::Touch>& touches) override {
    std::map<Key, Vec3> held;
    for (const contact::Touch& touch : touches) {
      held[{touch.sample, touch.number}] = touch.R_WG.transpose() * stretch(touch);
    }
    held_.swap(held);
  }
  void goOnFrom(const contact::Response& old, const SurfaceMap& now) override {
    for (const auto& [key, stretch_G] : dynamic_cast<const HoldResponse&>(old).held_) {
      const int sample = now.sample(key.first);
      if (sample >= 0) held_[{sample, key.second}] = stretch_G;
    }
  }
  void forget() override { held_.clear(); }
  void save(StateWriter* to) const override {
    to->put(static_cast<std::int64_t>(held_.size()));
    for (const auto& [key, stretch_G] : held_) {
      to->put(key.first);
      to->put(key.second);
      to->put(stretch_G);
    }
  }
  void restore(StateReader* from) override {
    held_.clear();
    for (std::int64_t left = from->count(2 * sizeof(int)); left > 0; --left) {
      Key key;
      from->get(&key.first);
      from->get(&key.second);
      from->get(&held_[key]);
    }
  }

 private:
  using Key = std::pair<int, int>;  // sample, Obstacle::number

  std::map<Key, Vec3>::const_iterator held(const contact::Touch& touch) const {
    return held_.find({touch.sample, touch.number});
  }
  // Of the spring, in world [m].
  Vec3 stretch(const contact::Touch& touch) const {
    const auto it = held(touch);
    if (it != held_.end()) return touch.R_WG * it->second + touch.motion_W;
    return touch.gap < 0.0 ? Vec3(touch.gap * touch.normal_W) : Vec3::Zero();
  }

  double stiffness_;
  std::map<Key, Vec3> held_;  // stretch at the last step's end, in the obstacle's frame [m]
};

inline std::unique_ptr<contact::Response> makeHoldResponse(
    const contact::ResponseSettings& settings) {
  return std::make_unique<HoldResponse>(settings.stiffness);
}

/// The line of the table.
inline const contact::ResponseEntry kHold{"hold", makeHoldResponse};

}  // namespace palpate::test
