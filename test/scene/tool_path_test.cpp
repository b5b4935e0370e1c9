// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/tool_path.h"

#include <gtest/gtest.h>

#include "support/contains.h"
#include "support/input_error.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::scene::tool_path_test {
namespace {

class ToolPath : public ::testing::Test {
 protected:
  Scene sceneOf(const std::string& rows) const {
    folder_.write("way.csv", "t,x,y,z,roll,pitch,yaw\n" + rows);
    Scene scene;
    scene.file = folder_.path("scene.yaml");
    InstrumentConfig probe;
    probe.name = "probe";
    probe.urdf = test::sourceFolder() + "/config/instruments/probe.urdf";
    probe.control_frame = "tip";
    scene.instruments = {probe};
    return scene;
  }
  static mesh::Polyline pathOf(const Scene& scene, const std::string& instrument = "") {
    OrganConfig organ;
    organ.name = "liver";
    organ.edge_length.near.resize(1);
    organ.edge_length.near[0].finest = 0.001;
    organ.edge_length.near[0].trajectory = "way.csv";
    organ.edge_length.near[0].instrument = instrument;
    return toolPath(scene, organ, 0);
  }
  mesh::Polyline pathOf(const std::string& rows) const { return pathOf(sceneOf(rows)); }
  std::string complaintOf(const std::string& rows) const {
    return test::complaint([&] { pathOf(rows); });
  }
  test::TempFolder folder_;
};

TEST_F(ToolPath, LeavesOutWhatLiesOnALine) {
  const mesh::Polyline path =
      pathOf("0,0,0,0,0,0,0\n1,0.01,0,0,0,0,0\n2,0.02,0,0,0,0,0\n3,0.02,0.05,0,0,0,0\n");
  ASSERT_EQ(path.points.size(), 3U);
  EXPECT_TRUE((path.points[1] - path.points[0]).isApprox(Vec3(0.02, 0, 0)));
}

TEST_F(ToolPath, LeadsNowhereFarOrWithoutEnd) {
  for (const char* far : {"1e300", "-1e308", "101"}) {
    EXPECT_TRUE(test::contains(complaintOf("0,0,0,0,0,0,0\n1," + std::string(far) + ",0,0,0,0,0\n"),
                               "way.csv: t = 1: must not lead the tool farther than 100 m"));
  }
  std::string rows;
  for (int i = 0; i < 30000; ++i) {
    rows += std::to_string(i) + "," + std::to_string(1e-3 * (i * 79 % 101)) + "," +
            std::to_string(1e-3 * (i * 57 % 97)) + ",0,0,0,0\n";
  }
  EXPECT_TRUE(test::contains(complaintOf(rows), "at most 20000 corners"));
}

TEST_F(ToolPath, IsThatOfAnInstrumentOfTheScene) {
  const Scene good = sceneOf("0,0,0,0,0,0,0\n1,0.01,0,0,0,0,0\n");
  const auto complaintOf = [&](const Scene& scene, const std::string& instrument = "") {
    return test::complaint([&] { pathOf(scene, instrument); });
  };
  EXPECT_TRUE(
      test::contains(complaintOf(good, "hook"), "near[0].instrument = hook: must be one of"));
  Scene other = good;
  other.instruments.clear();
  EXPECT_TRUE(test::contains(complaintOf(other), "there is no instrument in the scene"));
  other = good;
  other.instruments[0].urdf = "package://no_such_package/probe.urdf";
  EXPECT_TRUE(test::contains(complaintOf(other), "instrument probe.urdf"));
  other = good;
  other.instruments[0].control_frame = "top";
  EXPECT_TRUE(test::contains(complaintOf(other), "control_frame = top: must be a link of"));
  folder_.write("way.csv", "t,x,y\n0,0,0\n1,0,0\n");
  EXPECT_TRUE(test::contains(complaintOf(good), "way.csv"));
}

}  // namespace
}  // namespace palpate::scene::tool_path_test
