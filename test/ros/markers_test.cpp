// SPDX-License-Identifier: GPL-3.0-or-later
// Markers of organs whose triangles become others while they run.
#include "ros/pictures/markers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ros/pictures/anatomy_markers.h"
#include "ros/pictures/surface_copies.h"
#include "sim/anatomy_scene.h"
#include "support/splitting_model.h"

namespace palpate::node {
namespace {

class Markers : public ::testing::Test {
 protected:
  Picture picture() {
    Picture taken;
    for (int i = 0; i < 2; ++i) {
      taken.organs.push_back(copies.take(simulator.surfaceState(i), static_cast<std::size_t>(i)));
    }
    return taken;
  }
  void step() { simulator.step({simulator.linkPoses(0, Eigen::VectorXd::Zero(6))}, 0.01); }

  test::SlabScene slab;
  sim::Simulator simulator{scene::readScene(slab.file("", test::kSplittingOrgans))};
  SurfaceCopies copies;
  SceneMarkers markers{simulator, 0.02};
};

TEST_F(Markers, FollowTrianglesThatBecomeOthers) {
  for (int k = 0; k < 3; ++k) {
    const visualization_msgs::MarkerArray message = markers.update(picture());
    for (int i = 0; i < 2; ++i) {
      const visualization_msgs::Marker& m = message.markers[static_cast<std::size_t>(i)];
      const tissue::SurfaceState shape = simulator.surfaceState(i);
      EXPECT_EQ(m.action, visualization_msgs::Marker::ADD);
      ASSERT_EQ(m.points.size(), static_cast<std::size_t>(shape.triangles.size()));
      for (Eigen::Index c = 0; c < shape.triangles.size(); ++c) {
        const Vec3 corner = shape.positions.col(shape.triangles.data()[c]);
        ASSERT_EQ(m.points[static_cast<std::size_t>(c)].x, corner.x());
        ASSERT_EQ(m.points[static_cast<std::size_t>(c)].z, corner.z());
      }
    }
    step();
  }
}

// A picture that is shown late, or after a newer one, is still whole.
TEST_F(Markers, ShowAnyPictureWithItsOwnTriangles) {
  const Picture first = picture();
  step();
  const Picture second = picture();
  const std::size_t many = markers.update(second).markers[0].points.size();
  EXPECT_EQ(markers.update(first).markers[0].points.size() + 6, many);
}

TEST_F(Markers, CopyTrianglesOnlyWhenTheyBecomeOthers) {
  const Picture first = picture(), same = picture();
  EXPECT_EQ(first.organs[0].triangles, same.organs[0].triangles);
  step();
  EXPECT_NE(first.organs[0].triangles, picture().organs[0].triangles);
}

// The slab of 100 mm has them as they are, a block of 12 mm as much smaller.
TEST_F(Markers, AreThinOnSmallOrgans) {
  EXPECT_DOUBLE_EQ(markers.update(picture()).markers[2].scale.x, 0.0035);
  scene::Scene small = scene::readScene(slab.file());
  small.organs[0].scale = 0.12;
  const sim::Simulator simulator_of_small(small);
  SceneMarkers thin(simulator_of_small, 0.02);
  Picture taken;
  taken.organs.push_back(SurfaceCopies().take(simulator_of_small.surfaceState(0), 0));
  const visualization_msgs::MarkerArray& message = thin.update(taken);
  EXPECT_NEAR(message.markers[1].scale.x, 0.12 * 0.0035, 1e-12);
  EXPECT_NEAR(message.markers[2].scale.z, 0.12 * 0.012, 1e-12);
}

// Three times as long as they may be: the scale is halved twice, and stays so.
TEST_F(Markers, HalveTheScaleOfArrowsThatAreTooLong) {
  SceneMarkers fitting(simulator, 0.02, 0.04);
  const auto length = [&](double newton) {
    Picture taken = picture();
    taken.spatial = {{Vec3(0.0, 0.0, newton), Vec3::Zero()}};
    taken.X_WC = {Pose::Identity()};
    const visualization_msgs::Marker& arrow = fitting.update(taken).markers.back();
    return arrow.points[1].z - arrow.points[0].z;
  };
  EXPECT_DOUBLE_EQ(length(2.0), 0.04);
  EXPECT_DOUBLE_EQ(length(6.0), 0.03);
  EXPECT_DOUBLE_EQ(length(2.0), 0.01);
}

TEST(AnatomyMarkers, AreItsSurfaceInTheWorld) {
  const test::AnatomyScene files;
  const sim::Simulator simulator(
      files.scene(test::AnatomyScene::bone("plate.obj", "[0.5, 0, 0.05]")));
  const visualization_msgs::MarkerArray message = anatomyMarkers(simulator);
  ASSERT_EQ(message.markers.size(), 1u);
  const visualization_msgs::Marker& m = message.markers[0];
  EXPECT_EQ(m.action, visualization_msgs::Marker::ADD);
  EXPECT_EQ(m.header.frame_id, "world");
  EXPECT_EQ(m.points.size() % 3, 0u);
  ASSERT_FALSE(m.points.empty());
  double top = -1.0, right = -1.0;
  for (const auto& p : m.points) {
    top = std::max(top, p.z);
    right = std::max(right, p.x);
  }
  EXPECT_NEAR(top, 0.05, 1e-12);
  EXPECT_NEAR(right, 0.6, 1e-12);
  EXPECT_TRUE(anatomyMarkers(sim::Simulator(files.scene())).markers.empty());
}

// After those of the organs, where there is no organ.
TEST(AnatomyMarkers, ContactsOfToolsHaveAListOfTheirOwn) {
  const test::AnatomyScene files;
  sim::Simulator simulator(files.scene(test::AnatomyScene::bone("plate.obj", "[0.5, 0, 0.05]")));
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  q[0] = 0.5;
  q[2] = -0.046;
  const sim::StepResult& result = simulator.step({simulator.linkPoses(0, q)}, 0.01);
  SurfaceCopies copies;
  Picture picture;
  picture.organs.push_back(copies.take(simulator.surfaceState(0), 0));
  picture.contacts = result.contacts;
  picture.spatial = {result.instruments[0].spatial};
  picture.X_WC = {result.instruments[0].X_WC};
  SceneMarkers markers(simulator, 0.02);
  const visualization_msgs::MarkerArray message = markers.update(picture);
  ASSERT_EQ(message.markers.size(), 4u);            // the organ, contacts with both, the arrow
  EXPECT_EQ(message.markers[1].points.size(), 1u);  // of the splitting model, always there
  EXPECT_EQ(message.markers[2].points.size(), 1u);
  EXPECT_EQ(message.markers[2].action, visualization_msgs::Marker::ADD);
  EXPECT_EQ(message.markers[3].type, visualization_msgs::Marker::ARROW);
  EXPECT_EQ(message.markers[3].action, visualization_msgs::Marker::ADD);
}

}  // namespace
}  // namespace palpate::node
