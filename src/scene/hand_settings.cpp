// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/hand_settings.h"

#include "palpate/haptics/device_models.h"

namespace palpate::scene {

haptics::WrenchFilterSettings filterSettings(const Scene& scene,
                                             const InstrumentConfig& instrument) {
  const auto limit = [](double own, double of_all) { return own > 0.0 ? own : of_all; };
  const haptics::DeviceModel& device = haptics::deviceModel(instrument.device.model);
  haptics::WrenchFilterSettings s;
  s.max_force =
      limit(instrument.limits.max_force, limit(device.max_force, scene.haptics.max_force));
  s.max_torque =
      limit(instrument.limits.max_torque, limit(device.max_torque, scene.haptics.max_torque));
  s.max_force_rate = limit(instrument.limits.max_force_rate, scene.haptics.max_force_rate);
  // Force and torque reach their limits in the same time.
  s.max_torque_rate = s.max_force_rate * s.max_torque / s.max_force;
  s.ramp = scene.rates.ramp;
  return s;
}

}  // namespace palpate::scene
