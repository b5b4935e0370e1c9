// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace palpate::haptics {

/// Continuous force and torque of a commercial haptic device.
struct DeviceModel {
  std::string name;         ///< Name in scene files.
  std::string title;        ///< Maker and product.
  double max_force = 0.0;   ///< Continuous force [N]; 0: unknown or none.
  double max_torque = 0.0;  ///< Continuous torque [N m]; 0: unknown or none.
  std::string source;       ///< Source of both values.
};

/// All device models; the first, "other", has no data.
const std::vector<DeviceModel>& deviceModels();
std::vector<std::string> deviceModelNames();
/// @throws std::invalid_argument for an unknown name.
const DeviceModel& deviceModel(const std::string& name);

/// The page docs/devices.md, made from deviceModels().
std::string devicesMarkdown();

}  // namespace palpate::haptics
