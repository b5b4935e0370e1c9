// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "liver_slab.h"

namespace palpate::tissue::sharp_tool_test {
namespace {

constexpr double kStep = 0.01;

// Edges that run into a soft contact: there is always a place on them that is just in front of the
// surface or just behind it, and a slow cycle is not cut into stages for that.
TEST(SharpTool, GoesOnInFewStages) {
  test::LiverSlab slab("implicit_pcg", Eigen::Vector3i(6, 6, 3), "tet4");
  slab.settings.contact.model = "penalty";
  slab.settings.contact.stiffness = 1e6;
  const auto tissue = slab.make();
  const instrument::Geometry box = instrument::Box{Vec3(0.01, 0.01, 0.01)};
  const auto at = [](double z) {
    return poseFromXyzRpy(Vec3(0.052, 0.047, z), Vec3(0.9, 0.6, 0.0));
  };
  double z = 0.05;
  int touching = 0;
  for (int k = 0; k < 60; ++k) {
    const double next = z - 0.0005;
    const TissueStep& step = tissue->step({contact::Obstacle{&box, 0, at(z), at(next)}}, kStep);
    z = next;
    EXPECT_TRUE(step.ok()) << k;
    touching += !step.contacts.empty();
    EXPECT_LE(step.sweep_stages, 4) << k;
  }
  EXPECT_GT(touching, 20);
}

}  // namespace
}  // namespace palpate::tissue::sharp_tool_test
