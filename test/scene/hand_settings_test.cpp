// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/hand_settings.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "palpate/haptics/device_models.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::scene::hand_settings_test {
namespace {

TEST(HandSettings, LimitsOfAnInstrumentStandBeforeThoseOfItsDeviceAndOfAll) {
  Scene scene;
  scene.haptics.max_force = 20.0;
  scene.haptics.max_torque = 2.0;
  InstrumentConfig instrument;
  EXPECT_EQ(filterSettings(scene, instrument).max_force, 20.0);
  instrument.device.model = "sigma_7";
  EXPECT_EQ(filterSettings(scene, instrument).max_force, 12.0);
  EXPECT_EQ(filterSettings(scene, instrument).max_torque, 0.2);
  instrument.limits.max_force = 3.3;
  EXPECT_EQ(filterSettings(scene, instrument).max_force, 3.3);
  EXPECT_EQ(filterSettings(scene, instrument).max_torque, 0.2);
  EXPECT_EQ(filterSettings(scene, instrument).max_force_rate, scene.haptics.max_force_rate);
  instrument.device.model = "touch";  // no torque of its own
  EXPECT_EQ(filterSettings(scene, instrument).max_torque, 2.0);
}

TEST(DeviceModels, HaveASourceBesideEachNumber) {
  for (const haptics::DeviceModel& model : haptics::deviceModels()) {
    EXPECT_EQ(haptics::deviceModel(model.name).title, model.title);
    EXPECT_EQ(model.max_force > 0.0, !model.source.empty()) << model.name;
  }
  EXPECT_THROW(haptics::deviceModel("glove"), std::invalid_argument);
}

TEST(DeviceModels, AreThoseOfThePage) {
  EXPECT_EQ(test::fileBytes(test::sourceFolder() + "/docs/devices.md"), haptics::devicesMarkdown())
      << "regenerate: palpate docs devices > docs/devices.md";
}

}  // namespace
}  // namespace palpate::scene::hand_settings_test
