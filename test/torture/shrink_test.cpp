// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/shrink.h"

#include <gtest/gtest.h>

#include "support/temp_folder.h"

namespace palpate::torture::shrink_test {
namespace {

// Small and soft. Ended in the row in which the tools have left, it is not back at rest.
TortureScene endedTooEarly() {
  TortureScene scene = drawScene(1, 6361);
  const std::size_t rows = scene.leave + 1;
  scene.trajectory.t.resize(rows);
  scene.trajectory.values =
      Eigen::MatrixXd(scene.trajectory.values.leftCols(static_cast<Eigen::Index>(rows)));
  scene.rests = true;
  return scene;
}

TEST(Shrunk, IsPlainerAndFailsTheSame) {
  const TortureScene scene = endedTooEarly();
  ASSERT_GT(scene.tools.size(), 1u);
  ASSERT_GT(scene.friction, 0.0);
  const test::TempFolder folder;
  const RunLimits limits;
  const Outcome outcome = run(scene, folder.path(""), limits);
  ASSERT_TRUE(outcome.fails("rest"));
  const TortureScene small = shrunk(scene, {"rest", 0, ""}, folder.path(""), limits, 1e9);
  EXPECT_TRUE(run(small, folder.path(""), limits).fails("rest"));
  EXPECT_EQ(small.tools.size(), 1u);
  EXPECT_EQ(small.trajectory.columns.size(), 6u);
  EXPECT_LT(small.trajectory.t.size(), scene.trajectory.t.size());
  EXPECT_EQ(small.friction, 0.0);
  EXPECT_EQ(small.organs.front().element, "tet4");
  EXPECT_EQ(small.organs.front().law, "stable_neo_hookean");
}

// Tools that stand still at first, for so long that leaving out halves of it once is not enough.
TEST(Shrunk, LeavesNothingOutThatAnotherPassWould) {
  TortureScene scene = endedTooEarly();
  formats::Trajectory& all = scene.trajectory;
  constexpr Eigen::Index kStill = 300;
  const Eigen::Index rows = all.values.cols();
  Eigen::MatrixXd values(all.values.rows(), kStill + rows);
  values << all.values.col(0).replicate(1, kStill), all.values;
  all.values = values;
  const double step = all.t[1] - all.t[0];
  all.t.resize(static_cast<std::size_t>(kStill + rows));
  for (std::size_t k = 0; k < all.t.size(); ++k) all.t[k] = step * static_cast<double>(k);
  scene.leave += kStill;
  const test::TempFolder folder;
  const TortureScene small = shrunk(scene, {"rest", 0, ""}, folder.path(""), RunLimits(), 1e9);
  EXPECT_TRUE(run(small, folder.path(""), RunLimits()).fails("rest"));
  EXPECT_LE(small.trajectory.t.size(), endedTooEarly().trajectory.t.size());
  const TortureScene again = shrunk(small, {"rest", 0, ""}, folder.path(""), RunLimits(), 1e9);
  EXPECT_EQ(again.trajectory.t.size(), small.trajectory.t.size());
}

// What does not fail is left as it is.
TEST(Shrunk, IsTheSceneItselfWhereNothingPlainerFails) {
  TortureScene scene = endedTooEarly();
  const test::TempFolder folder;
  const TortureScene small = shrunk(scene, {"crash", 0, ""}, folder.path(""), RunLimits(), 1e9);
  EXPECT_EQ(small.tools.size(), scene.tools.size());
  EXPECT_EQ(small.trajectory.t, scene.trajectory.t);
  EXPECT_EQ(small.organs.front().law, scene.organs.front().law);
}

}  // namespace
}  // namespace palpate::torture::shrink_test
