// SPDX-License-Identifier: GPL-3.0-or-later
// Tools that begin where the tissue is.
#include <gtest/gtest.h>

#include "slab.h"

namespace palpate::tissue::inside_tools_test {
namespace {

using test::kStep;
using test::onTool;

// A ball over the middle of the slab, whose top is at z = 0.04.
struct Ball {
  std::unique_ptr<TissueModel> tissue;
  instrument::Geometry shape;
  double radius, deep;

  Ball(double r, double begins) : shape(instrument::Sphere{r}), radius(r), deep(begins) {
    test::Slab slab;
    slab.settings.gravity.setZero();
    tissue = slab.make();
  }
  const TissueStep& to(double depth) {
    const auto at = [&](double d) {
      return poseFromXyzRpy(Vec3(0.05, 0.05, 0.04 + radius - d), Vec3::Zero());
    };
    const contact::Obstacle way{&shape, 0, at(deep), at(depth)};
    deep = depth;
    return tissue->step({way}, kStep);
  }
};

// Pressed out at once it would throw the hand with tens of kilonewtons.
TEST(InsideTools, HoldALargeToolThatBeginsDeepUntilItIsClear) {
  Ball ball(0.06, 0.025);
  for (int k = 0; k <= 10; ++k) {
    const TissueStep& step = ball.to(0.025 - 0.003 * k);  // up to 5 mm above it
    EXPECT_EQ(step.tools_inside, k < 9 ? 1 : step.tools_inside) << k;
    if (step.tools_inside > 0) {
      EXPECT_EQ(onTool(step).norm(), 0.0) << k;
    }
  }
  EXPECT_EQ(ball.to(-0.005).tools_inside, 0);
  for (int k = 0; k < 8; ++k) ball.to(-0.005 + 0.001 * k);
  EXPECT_EQ(ball.to(0.002).tools_inside, 0);
  EXPECT_GT(onTool(ball.to(0.002)).z(), 0.1);
}

TEST(InsideTools, HaveAToolPressThatBeginsALittleIn) {
  Ball ball(0.01, 0.001);
  const TissueStep& step = ball.to(0.001);
  EXPECT_EQ(step.tools_inside, 0);
  EXPECT_GT(onTool(step).z(), 0.01);
}

// However deep it is pressed, it is not taken for one that has just come.
TEST(InsideTools, StayThoseOfAToolThatIsPressedIn) {
  Ball ball(0.01, -0.001);
  for (int k = 0; k < 50; ++k) {
    const TissueStep& step = ball.to(-0.001 + 0.0002 * k);
    EXPECT_EQ(step.tools_inside, 0) << k;
  }
  EXPECT_GT(onTool(ball.to(0.009)).z(), 0.3);
}

}  // namespace
}  // namespace palpate::tissue::inside_tools_test
