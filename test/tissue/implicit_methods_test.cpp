// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/solver/minimizer_list.h"
#include "slab.h"

namespace palpate::tissue {
namespace {

using test::kStep;
using test::onTool;
using test::Press;
using test::Slab;

Slab slabFor(const std::string& method) {
  Slab slab(Eigen::Vector3i(6, 6, 3));
  slab.settings.method = method;
  return slab;
}

class EveryImplicitMethod : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryImplicitMethod,
                         ::testing::ValuesIn(solver::minimizerNames()),
                         [](const auto& name) { return name.param; });

TEST_P(EveryImplicitMethod, FeelsTheSameInEveryCycle) {
  Slab exact = slabFor("implicit_direct");
  exact.settings.tolerance = 1e-8;
  const Slab slab = slabFor(GetParam());
  const auto reference = exact.make(), tissue = slab.make();
  double error = 0.0, peak = 0.0;
  for (Press a, b; !a.done();) {
    const Vec3 expected = onTool(reference->step({a.next()}, kStep));
    const TissueStep& step = tissue->step({b.next()}, kStep);
    ASSERT_TRUE(step.ok()) << solver::toString(step.status);
    EXPECT_EQ(step.time_steps, 1);
    const Vec3 sum = step.support_force + step.gravity_force + step.inertia_force - onTool(step);
    EXPECT_LE(sum.norm(), std::sqrt(slab.mesh.numPoints()) * step.tolerance + 1e-9);
    error = std::max(error, (onTool(step) - expected).norm());
    peak = std::max(peak, expected.norm());
  }
  EXPECT_GT(peak, 0.3);
  EXPECT_LT(error, 1e-3 * peak);
}

TEST_P(EveryImplicitMethod, SameBitsWithThreadsAndAfterAReset) {
  ThreadPool pool(2);
  const Slab slab = slabFor(GetParam());
  const auto one = slab.make(), two = slab.make(&pool);
  for (Press a, b; !a.done();) {
    one->step({a.next()}, kStep);
    two->step({b.next()}, kStep);
    ASSERT_EQ(one->positions(), two->positions());
  }
  const Points first = one->positions();
  one->reset();
  for (Press press; !press.done();) one->step({press.next()}, kStep);
  EXPECT_EQ(one->positions(), first);
}

TEST_P(EveryImplicitMethod, ComesToRestAndSleeps) {
  const auto tissue = slabFor(GetParam()).make();
  const Points begin = tissue->positions();
  for (Press press; !press.done();) tissue->step({press.next()}, kStep);
  bool slept = false;
  for (int k = 0; k < 500 && !slept; ++k) slept = tissue->step({}, kStep).slept;
  EXPECT_TRUE(slept);
  EXPECT_LT((tissue->positions() - begin).cwiseAbs().maxCoeff(), 1e-4 * 0.1);
}

}  // namespace
}  // namespace palpate::tissue
