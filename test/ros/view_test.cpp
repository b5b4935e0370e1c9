// SPDX-License-Identifier: GPL-3.0-or-later
// How rviz shows a scene: what the camera sees, which displays there are, what is said in words.
#include "ros/pictures/view.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "ros/pictures/rviz_config.h"
#include "ros/pictures/state_text.h"
#include "sim/slab_scene.h"
#include "support/contains.h"

namespace palpate::node::view_test {
namespace {

using visualization_msgs::Marker;

/// Where a point is in a window, from -1 to 1 across and upright, by rviz's orbiting camera.
Eigen::Vector2d inWindow(const View& view, const Vec3& point, double aspect) {
  const double c = std::cos(view.pitch);
  const Vec3 eye = view.focus + view.distance * Vec3(c * std::cos(view.yaw), c * std::sin(view.yaw),
                                                     std::sin(view.pitch));
  const Vec3 forward = (view.focus - eye).normalized();
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized(), up = right.cross(forward);
  const Vec3 p = point - eye;
  const double half = p.dot(forward) * std::tan(0.5 * kFieldOfView);
  return {p.dot(right) / (half * aspect), p.dot(up) / half};
}

TEST(View, HasTheWholeOrganInTheWindow) {
  const test::SlabScene slab;
  scene::Scene scene = slab.scene();
  for (const double scale : {1.0, 0.1, 5.0}) {
    scene.organs[0].scale = scale;
    const sim::Simulator simulator(scene);
    const View view = makeView(simulator);
    EXPECT_NEAR(view.size(), 0.1 * scale, 0.01 * scale);  // it sags under its weight
    double most = 0.0;
    const Points& x = simulator.positions(0);
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      most = std::max(most, inWindow(view, x.col(i), 1.3).cwiseAbs().maxCoeff());
    }
    EXPECT_LT(most, 0.9) << scale;
    EXPECT_GT(most, 0.5) << scale;
  }
}

TEST(View, HasArrowsThatFitTheOrganAndItsStiffness) {
  const test::SlabScene slab;
  scene::Scene scene = slab.scene();
  const sim::Simulator soft(scene);
  scene.organs[0].material.constants["young_modulus"] = {6.0e4};
  const sim::Simulator stiff(scene);
  // But for how far it sags.
  EXPECT_NEAR(makeView(stiff).arrow_scale / makeView(soft).arrow_scale, 0.1, 0.01);
  // Pressed by 10 mm, twice the ball's radius, which takes 2.8 times the force of one, and dragged,
  // on edges of 17 mm, which make it larger: the guess may be an order of magnitude below.
  double peak = 0.0;
  sim::Simulator simulator(scene::readScene(slab.file()));
  for (const Eigen::VectorXd& q : test::SlabScene::press()) {
    peak = std::max(
        peak,
        simulator.step({simulator.linkPoses(0, q)}, 0.01).instruments[0].spatial.force.norm());
  }
  EXPECT_GT(typicalForce(soft), peak / 12.0);
  EXPECT_LT(typicalForce(soft), peak);
}

TEST(View, KnowsANeedle) {
  const test::SlabScene slab;
  scene::Scene scene = slab.scene();
  scene.instruments[0].needle.link = "shaft";
  scene.instruments[0].needle.puncture_force = 3.0;
  EXPECT_DOUBLE_EQ(typicalForce(sim::Simulator(scene)), 3.0);
}

TEST(RvizConfig, ShowsEachInstrumentAndTopicOfTheScene) {
  const RvizNames names{"/organs",
                        "/cut",
                        "/bones",
                        "/state",
                        {{"left", "/left/robot_description", "/left/w"},
                         {"right", "/ns/right/robot_description", "/right/w"}}};
  View view;
  view.focus = Vec3(0.1, -0.2, 0.3);
  view.distance = 0.7;
  view.arrow_scale = 0.123;
  const YAML::Node config = YAML::Load(rvizConfig(view, names));
  std::set<std::string> found;
  for (const YAML::Node& display : config["Visualization Manager"]["Displays"]) {
    for (const char* key : {"Marker Topic", "Robot Description", "Topic"}) {
      if (display[key])
        found.insert(display["Class"].as<std::string>() + " " + display[key].as<std::string>());
    }
    if (display["Force Arrow Scale"]) {
      EXPECT_DOUBLE_EQ(display["Force Arrow Scale"].as<double>(), 0.123);
    }
  }
  EXPECT_EQ(found,
            (std::set<std::string>{"rviz/MarkerArray /organs", "rviz/MarkerArray /cut",
                                   "rviz/MarkerArray /bones", "rviz/Marker /state",
                                   "rviz/RobotModel /left/robot_description",
                                   "rviz/RobotModel /ns/right/robot_description",
                                   "rviz/WrenchStamped /left/w", "rviz/WrenchStamped /right/w"}));
  const YAML::Node camera = config["Visualization Manager"]["Views"]["Current"];
  EXPECT_DOUBLE_EQ(camera["Distance"].as<double>(), 0.7);
  EXPECT_DOUBLE_EQ(camera["Focal Point"]["Y"].as<double>(), -0.2);
}

class StateTexts : public ::testing::Test {
 protected:
  std::string text(NodeState state, ToolState left = ToolState::kLive,
                   ToolState right = ToolState::kLive) {
    changed = words.update(state, {left, right});
    EXPECT_EQ(words.marker().action, words.marker().text.empty() ? Marker::DELETE : Marker::ADD);
    return words.marker().text;
  }
  StateText words{View(), {"left", "right"}, {"topic a", "topic b"}};
  bool changed = false;
};

TEST_F(StateTexts, SayWhyThereIsNoForce) {
  EXPECT_EQ(text(NodeState::kWaiting), "WAITING for topic a, topic b");
  EXPECT_EQ(text(NodeState::kRunning), "");
  EXPECT_TRUE(test::contains(text(NodeState::kPaused), "PAUSED"));
  EXPECT_TRUE(test::contains(text(NodeState::kFault), "FAULT"));
  const std::string outside = text(NodeState::kRunning, ToolState::kLive, ToolState::kOutside);
  EXPECT_TRUE(test::contains(outside, "right"));
  EXPECT_FALSE(test::contains(outside, "left"));
}

TEST_F(StateTexts, SayThatMeshesAreCoarser) {
  const std::vector<ToolState> tools(2, ToolState::kLive);
  EXPECT_TRUE(words.update(NodeState::kRunning, tools, 1.68));
  EXPECT_TRUE(test::contains(words.marker().text, "1.7 times"));
  EXPECT_TRUE(words.update(NodeState::kRunning, tools, 1.0));
  EXPECT_EQ(words.marker().text, "");
  EXPECT_TRUE(words.update(NodeState::kFault, tools, 1.68));
  EXPECT_FALSE(test::contains(words.marker().text, "times"));
}

TEST_F(StateTexts, AreNewsWhereTheyChange) {
  text(NodeState::kRunning);
  EXPECT_TRUE(changed);  // whatever rviz had from a node before
  text(NodeState::kRunning);
  EXPECT_FALSE(changed);
  text(NodeState::kFault);
  EXPECT_TRUE(changed);
}

TEST_F(StateTexts, StandAboveTheOrgans) {
  View view;
  view.box_min = Vec3(1.0, 0.0, 0.0);
  view.box_max = Vec3(1.2, 0.1, 0.5);
  const Marker marker = StateText(view, {}, {}).marker();
  EXPECT_EQ(marker.type, Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(marker.header.frame_id, "world");
  EXPECT_GT(marker.pose.position.z, 0.5);
  EXPECT_NEAR(marker.pose.position.x, 1.1, 1e-12);
  EXPECT_GT(marker.scale.z, 0.0);
  EXPECT_LT(marker.scale.z, 0.1);
}

}  // namespace
}  // namespace palpate::node::view_test
