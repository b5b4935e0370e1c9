// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace palpate::haptics {

/// What a haptic device on the market sustains.
struct DeviceModel {
  std::string name;         ///< In scene files.
  std::string title;        ///< Maker and product.
  double max_force = 0.0;   ///< [N]; 0: not known, or none.
  double max_torque = 0.0;  ///< [N m]; likewise.
  std::string source;       ///< Of both.
};

/// All that are known, "other" first: one of which nothing is.
const std::vector<DeviceModel>& deviceModels();
std::vector<std::string> deviceModelNames();
/// @throws std::invalid_argument if there is none of that name.
const DeviceModel& deviceModel(const std::string& name);

/// docs/devices.md, from that list.
std::string devicesMarkdown();

}  // namespace palpate::haptics
