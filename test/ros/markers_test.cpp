// SPDX-License-Identifier: GPL-3.0-or-later
// Markers of organs whose triangles become others while they run.
#include "markers.h"

#include <gtest/gtest.h>

#include "sim/slab_scene.h"
#include "support/splitting_model.h"
#include "surface_copies.h"

namespace palpate::node {
namespace {

class Markers : public ::testing::Test {
 protected:
  Picture picture() {
    Picture taken;
    for (int i = 0; i < 2; ++i) {
      taken.organs.push_back(copies.take(simulator.shape(i), static_cast<std::size_t>(i)));
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
      const tissue::Shape shape = simulator.shape(i);
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

}  // namespace
}  // namespace palpate::node
