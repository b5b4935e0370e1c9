// SPDX-License-Identifier: GPL-3.0-or-later
// Organs that are shown cut open.
#include "ros/pictures/cutaway_markers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ros/pictures/surface_copies.h"
#include "sim/slab_scene.h"
#include "support/source_folder.h"

namespace palpate::node::cutaway_markers_test {
namespace {

using visualization_msgs::Marker;

// What a list of triangles holds.
struct Hull {
  double volume = 0.0;       // [m^3]
  Vec3 open = Vec3::Zero();  // sum of area vectors [m^2]; 0 where it is closed
};

Vec3 at(const Marker& m, std::size_t k) { return {m.points[k].x, m.points[k].y, m.points[k].z}; }

Hull hullOf(const Marker& m) {
  const Vec3 apart(0.02, -0.03, 0.05);  // in no plane of a cut, so that all faces count
  Hull hull;
  for (std::size_t k = 0; k + 2 < m.points.size(); k += 3) {
    const Vec3 a = at(m, k) - apart, b = at(m, k + 1) - apart, c = at(m, k + 2) - apart;
    hull.volume += a.dot(b.cross(c)) / 6.0;
    hull.open += 0.5 * (b - a).cross(c - a);
  }
  return hull;
}

// The organ of a scene, as the node's threads pass it on.
class Shown {
 public:
  Shown(const scene::Scene& scene, const CutawayConfig& config)
      : simulator(scene), markers_(simulator, config) {}

  const visualization_msgs::MarkerArray& show() {
    take();
    return markers_.update(picture);
  }
  // As if it were at rest.
  const visualization_msgs::MarkerArray& showRest() {
    take();
    picture.organs[0].positions = picture.organs[0].cells->points;
    return markers_.update(picture);
  }

  sim::Simulator simulator;
  Picture picture;

 private:
  void take() {
    picture.organs = {copies_.take(simulator.surfaceState(0), 0)};
    copies_.addCells(simulator, 0, &picture.organs[0]);
  }

  SurfaceCopies copies_;
  CutawayMarkers markers_;
};

scene::Scene tilted(const test::SlabScene& files) {
  scene::Scene scene = files.scene();
  scene.gravity.setZero();
  scene.organs[0].pose.roll_pitch_yaw = Vec3(0.2, -0.1, 0.3);
  return scene;
}

// Skin on fat, each of half of the height, of which a quarter is taken away.
TEST(CutawayMarkers, ShowTheLayersInside) {
  Shown skin(scene::readScene(test::sourceFolder() + "/config/scenes/skin_two_layer.yaml"),
             CutawayConfig());
  const visualization_msgs::MarkerArray& message = skin.show();
  ASSERT_EQ(message.markers.size(), 2u);
  const Marker &cut = message.markers[0], &nodes = message.markers[1];
  EXPECT_EQ(cut.action, Marker::ADD);
  EXPECT_EQ(cut.type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(cut.header.frame_id, "world");
  ASSERT_EQ(cut.points.size(), cut.colors.size());
  const Hull hull = hullOf(cut);
  EXPECT_NEAR(hull.volume, 0.75 * 0.012 * 0.012 * 0.0045, 1e-15);
  EXPECT_LT(hull.open.norm(), 1e-15);
  double upper = 0.0, lower = 0.0;
  for (std::size_t k = 0; k < cut.points.size(); k += 3) {
    const Vec3 a = at(cut, k), b = at(cut, k + 1), c = at(cut, k + 2);
    if (std::abs(a.x()) + std::abs(b.x()) + std::abs(c.x()) > 1e-12) continue;
    const bool is_upper = (a + b + c).z() / 3.0 > 0.00225;
    (is_upper ? upper : lower) += 0.5 * (b - a).cross(c - a).norm();
    EXPECT_EQ(cut.colors[k].b < 0.8F * cut.colors[k].g, !is_upper);  // fat is yellow
  }
  EXPECT_NEAR(upper, 0.006 * 0.00225, 1e-14);
  EXPECT_NEAR(lower, 0.006 * 0.00225, 1e-14);
  EXPECT_EQ(nodes.type, Marker::SPHERE_LIST);
  EXPECT_EQ(nodes.points.size(), 7u * 7u * 7u);  // of 13 x 13 x 7
  for (const auto& p : nodes.points) {
    EXPECT_GE(p.x, -1e-12);
    EXPECT_LE(p.y, 1e-12);
  }
}

TEST(CutawayMarkers, CutInTheFrameOfTheOrgan) {
  const test::SlabScene files;
  CutawayConfig half;
  half.corner = {-1, 0, 0};
  half.at = Vec3(0.03, 0.0, 0.0);
  half.has_place = true;
  Shown slab(tilted(files), half);
  const Hull hull = hullOf(slab.show().markers[0]);
  EXPECT_NEAR(hull.volume, 0.07 * 0.1 * 0.04, 1e-12);
  EXPECT_LT(hull.open.norm(), 1e-14);

  CutawayConfig notch;
  notch.corner = {1, -1, 1};
  notch.size = Vec3(0.01, 0.02, 0.0);
  Shown notched(tilted(files), notch);
  const Hull rest = hullOf(notched.show().markers[0]);
  EXPECT_NEAR(rest.volume, 0.1 * 0.1 * 0.04 - 0.01 * 0.02 * 0.02, 1e-12);
  EXPECT_LT(rest.open.norm(), 1e-14);
}

// Pressed, it stays closed; of a mesh that became another one it is found anew.
TEST(CutawayMarkers, FollowTheOrganAndItsMesh) {
  const test::SlabScene files;
  scene::Scene scene = files.scene();
  scene.organs[0].adapt.finest = 0.008;
  Shown slab(scene, CutawayConfig());
  const auto press = [&](double depth) {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q[2] = -0.055 - depth;
    slab.simulator.step({slab.simulator.linkPoses(0, q)}, 0.01);
  };
  const Marker& cut = slab.show().markers[0];
  const auto cells = slab.picture.organs[0].cells;
  const std::size_t coarse = cut.points.size();
  const geometry_msgs::Point* storage = cut.points.data();
  const std_msgs::ColorRGBA* colours = cut.colors.data();
  slab.show();
  EXPECT_EQ(slab.picture.organs[0].cells, cells);
  EXPECT_EQ(cut.points.data(), storage);
  EXPECT_EQ(cut.colors.data(), colours);
  for (int k = 0; k < 20; ++k) press(3e-4 * k);
  slab.show();
  EXPECT_NE(slab.picture.organs[0].cells, cells);
  EXPECT_GT(cut.points.size(), coarse);
  EXPECT_LT(hullOf(cut).open.norm(), 1e-14);
  EXPECT_EQ(cut.points.size(), cut.colors.size());
  slab.showRest();
  EXPECT_NEAR(hullOf(cut).volume, 0.75 * 0.1 * 0.1 * 0.04, 1e-12);
  slab.simulator.reset();
  slab.show();
  EXPECT_EQ(cut.points.size(), coarse);
}

// Until a picture has cells; one with a point that is nowhere changes nothing.
TEST(CutawayMarkers, WaitForCells) {
  const test::SlabScene files;
  const sim::Simulator simulator(tilted(files));
  SurfaceCopies copies;
  CutawayMarkers markers(simulator, CutawayConfig());
  Picture picture;
  picture.organs.push_back(copies.take(simulator.surfaceState(0), 0));
  for (const Marker& m : markers.update(picture).markers) EXPECT_EQ(m.action, Marker::DELETE);
  copies.addCells(simulator, 0, &picture.organs[0]);
  const auto before = markers.update(picture).markers[0].points;
  EXPECT_FALSE(before.empty());
  picture.organs[0].positions(0, 0) = std::nan("");
  EXPECT_EQ(markers.update(picture).markers[0].points, before);
}

}  // namespace
}  // namespace palpate::node::cutaway_markers_test
