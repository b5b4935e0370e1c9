// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/device_models.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace palpate::haptics {
namespace {

constexpr char kPhantoms[] = "CHAI3D 3.2, src/devices/CPhantomDevices.cpp";
constexpr char kDeltas[] = "CHAI3D 3.2, src/devices/CDeltaDevices.cpp";
constexpr char kFalcon[] = "CHAI3D, src/devices/CFalconDevice.cpp";
constexpr char kMtm[] =
    "sawIntuitiveResearchKit, share/kinematic/mtmr.json: 3.217 N m of the shoulder's pitch at a "
    "reach "
    "of 0.2794 + 0.3645 m; the torque is that of the wrist's roll";

}  // namespace

const std::vector<DeviceModel>& deviceModels() {
  static const std::vector<DeviceModel> kModels = {
      {"other", "any other", 0.0, 0.0, ""},
      {"touch", "3D Systems Touch", 3.3, 0.0, kPhantoms},
      {"omni", "SensAble PHANTOM Omni", 3.3, 0.0, kPhantoms},
      {"desktop", "SensAble PHANTOM Desktop", 7.9, 0.0, kPhantoms},
      {"premium_1_5", "SensAble PHANTOM Premium 1.5, six axes", 8.5, 0.188, kPhantoms},
      {"falcon", "Novint Falcon", 8.0, 0.0, kFalcon},
      {"omega_3", "Force Dimension omega.3", 12.0, 0.0, kDeltas},
      {"omega_7", "Force Dimension omega.7", 12.0, 0.0, kDeltas},
      {"sigma_7", "Force Dimension sigma.7", 12.0, 0.2, kDeltas},
      {"delta_3", "Force Dimension delta.3", 20.0, 0.0, kDeltas},
      {"dvrk_mtm", "da Vinci Research Kit, master tool manipulator", 5.0, 0.0229, kMtm}};
  return kModels;
}

std::vector<std::string> deviceModelNames() {
  std::vector<std::string> names;
  for (const DeviceModel& model : deviceModels()) names.push_back(model.name);
  return names;
}

const DeviceModel& deviceModel(const std::string& name) {
  const auto& all = deviceModels();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const DeviceModel& model) { return model.name == name; });
  if (found == all.end()) throw std::invalid_argument("no device model " + name);
  return *found;
}

std::string devicesMarkdown() {
  std::ostringstream text;
  text << "# Devices\n\n"
          "What `instruments[].device.model` stands for: the force and the torque that its makers' "
          "and\n"
          "users' drivers allow, which limit what is sent where `instruments[].limits` say "
          "nothing.\n"
          "They are limits of drivers, not measurements; mass, damping and delay are to be "
          "given.\n\n"
          "| model | device | force | torque | source |\n|---|---|---|---|---|\n";
  const auto number = [](double value, const char* unit) {
    std::ostringstream words;
    if (value > 0.0) words << value << " " << unit;
    return words.str();
  };
  for (const DeviceModel& m : deviceModels()) {
    if (m.source.empty()) continue;
    text << "| `" << m.name << "` | " << m.title << " | " << number(m.max_force, "N") << " | "
         << number(m.max_torque, "N m") << " | " << m.source << " |\n";
  }
  return text.str();
}

}  // namespace palpate::haptics
