// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/force_renderer.h"

#include <algorithm>

namespace palpate::haptics {
namespace {

constexpr double kCatchUp = 0.05;  // time for a tool to catch up after a jump [s]

PassivitySettings within(PassivitySettings settings, const DeviceLimits& limits) {
  settings.max_damping = std::min(settings.max_damping, limits.maxDamping());
  return settings;
}

}  // namespace

ForceRenderer::ForceRenderer(const WrenchFilterSettings& filter, const PassivitySettings& passivity,
                             const DeviceSettings& device, double tick)
    : passivity_(within(passivity, DeviceLimits(device, tick)), device.delay), filter_(filter) {}

const Wrench& ForceRenderer::update(const RenderTarget& target, const Vec3& p_hand, double dt) {
  velocity_.update(p_hand, dt);
  const Vec3& v = velocity_.velocity();
  const bool parted = velocity_.sinceLeap() < kCatchUp;
  Wrench felt = target.contact.expected && parted ? Wrench() : target.contact.at(p_hand, v);
  felt.force += target.coupling_W;
  felt.force += passivity_.update(p_hand, v, filter_.output().force, felt.force, dt);
  return filter_.update(felt, target.live, dt);
}

const Wrench& ForceRenderer::fade(double dt) { return filter_.update(Wrench(), false, dt); }

}  // namespace palpate::haptics
