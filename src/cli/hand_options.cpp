// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_options.h"

#include <algorithm>

#include "options.h"
#include "palpate/scene/hand_settings.h"

namespace palpate::cli {
namespace {

constexpr double kHeavy = 1.0e6;  // [kg] a device that nothing is too stiff for

struct Grip {
  const char* name;
  haptics::HandSettings hand;
  double push;  // instead of a place to be [N]
};

// Mass of device and hand [kg], damping of the device, stiffness and damping of the grip.
constexpr Grip kGrips[] = {{"light", {0.10, 0.2, 100.0, 1.0, 5.5e-5, 0.0, 0.0}, 0.0},
                           {"normal", {0.15, 0.2, 300.0, 3.0, 5.5e-5, 0.0, 0.0}, 0.0},
                           {"firm", {0.30, 0.2, 1000.0, 10.0, 5.5e-5, 0.0, 0.0}, 0.0},
                           {"limp", {0.05, 0.2, 0.0, 0.0, 5.5e-5, 100.0, 1.0}, 0.5}};

const Grip& gripOf(const HandOptions& o) {
  return *std::find_if(std::begin(kGrips), std::end(kGrips),
                       [&](const Grip& g) { return g.name == o.grip; });
}

}  // namespace

std::vector<std::string> gripNames() {
  std::vector<std::string> names;
  for (const Grip& grip : kGrips) names.emplace_back(grip.name);
  return names;
}

double gripPush(const HandOptions& o) { return gripOf(o).push; }

sim::HandLoopSettings settingsFrom(const HandOptions& o, const scene::Scene& scene) {
  const scene::InstrumentConfig& instrument = scene.instruments[0];
  sim::HandLoopSettings s;
  s.hand = gripOf(o).hand;
  s.hand.mass = o.mass.value_or(s.hand.mass);
  s.hand.device_damping = o.damping.value_or(s.hand.device_damping);
  s.hand.grip_stiffness = o.stiffness.value_or(s.hand.grip_stiffness);
  s.hand.grip_damping = o.grip_damping.value_or(s.hand.grip_damping);
  s.hand.resolution = o.resolution.value_or(s.hand.resolution);
  s.filter = scene::filterSettings(scene, instrument);
  s.filter.smoothing = o.hold ? 0.5 / o.rate : 0.0;
  s.cycle = 1.0 / o.rate;
  s.solve = o.solve;
  s.delay_in = o.delay_in;
  s.delay_out = o.delay_out;
  s.local_model = !o.hold;
  s.passivity = scene.haptics;
  s.passivity.max_damping = o.passivity.value_or(scene.haptics.max_damping);
  s.coupling = instrument.proxy;
  s.device_rate = o.device_rate;
  s.prescribed = o.prescribed;
  s.ahead = !o.late && !o.hold;
  s.told = instrument.device;
  if (!s.ahead) s.told.mass = kHeavy;
  if (o.untold || !s.ahead) return s;
  s.told.damping = s.hand.device_damping;
  s.told.delay = o.delay_in + o.delay_out;
  s.told.rate = o.device_rate;
  s.told.mass = std::min(s.told.mass, s.hand.mass);
  return s;
}

void checkNumbers(const HandOptions& o) {
  requirePositive("--rate", o.rate);
  requirePositive("--duration", o.duration);
  requirePositive("--speed", o.speed);
  requirePositive("--device-rate", o.device_rate);
  requirePositive("--mass", o.mass.value_or(1.0));
  requireNotNegative("--depth", o.depth);
  requireNotNegative("--push", o.push);
  requireNotNegative("--solve", o.solve);
  requireNotNegative("--delay-in", o.delay_in);
  requireNotNegative("--delay-out", o.delay_out);
  requireNotNegative("--damping", o.damping.value_or(0.0));
  requireNotNegative("--grip-stiffness", o.stiffness.value_or(0.0));
  requireNotNegative("--grip-damping", o.grip_damping.value_or(0.0));
  requireNotNegative("--resolution", o.resolution.value_or(0.0));
  requireNotNegative("--passivity", o.passivity.value_or(0.0));
}

}  // namespace palpate::cli
