// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped block of skin on fat on bone is pressed by a blunt needle at two depths, and let go.
#include <cstdio>

#include "palpate/skin/two_layer_block.h"
#include "shipped_replay.h"

namespace palpate::sim::skin_scene_test {
namespace {

// Force on a flat punch by a depth, of a disc of the same layers; linear and small [N/m].
double punch(double radius) {
  skin::TwoLayerBlock block;
  block.idealization = skin::Idealization::kAxisymmetric;
  block.diagonals = skin::Diagonals::kAlternating;
  block.columns = 192;
  block.rows = 72;
  block.upper_rows = 36;
  block.patch = radius;
  return skin::indent(block).force;
}

TEST(SkinScene, PushesBackAtBothDepthsAndLetsGo) {
  test::ShippedReplay replay("skin_two_layer");
  const auto force = [&](double t) { return replay.to(t).instruments[0].spatial.force; };
  const Points rest = replay.simulator().positions(0);
  EXPECT_EQ(force(0.2).norm(), 0.0);
  // The tip has a radius of 0.5 mm, and what it touches is narrower than a punch as wide: between
  // one of half its radius and that.
  const double low = punch(0.25e-3), high = punch(0.5e-3);
  double last = 0.0;
  for (const auto& [t, depth] : {std::pair(1.2, 0.9e-3), std::pair(2.0, 1.8e-3)}) {
    const Vec3 held = force(t);
    std::printf("%.1f mm: %.3f N; punches %.3f and %.3f N\n", 1e3 * depth, held.z(), low * depth,
                high * depth);
    EXPECT_GT(held.z(), low * depth);
    EXPECT_LT(held.z(), high * depth);
    EXPECT_LT(held.head<2>().norm(), 2e-2 * held.z());
    EXPECT_GT(held.z(), last);
    last = held.z();
  }
  EXPECT_EQ(force(3.2).norm(), 0.0);
  const Points end = replay.simulator().positions(0);
  EXPECT_LT((end.leftCols(rest.cols()) - rest).cwiseAbs().maxCoeff(), 2e-5);
}

}  // namespace
}  // namespace palpate::sim::skin_scene_test
