// SPDX-License-Identifier: GPL-3.0-or-later
// What every tissue model owes, whatever it computes: forces that cancel, momentum that stays, rest
// that comes back, the same bits for any number of threads and from a saved state.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model_variants.h"

namespace palpate::tissue::every_model_test {
namespace {

using test::kStep;
using test::ModelVariant;
using test::onTool;
using test::Visit;

Vec3 imbalance(const TissueStep& step) {
  return step.support_force + step.gravity_force + step.inertia_force - onTool(step);
}

class EveryModel : public ::testing::TestWithParam<ModelVariant> {
 protected:
  std::unique_ptr<TissueModel> make(ThreadPool* pool = nullptr) const {
    return test::makeVariant(GetParam(), organ_, test::variantSettings(), pool);
  }
  test::OrganSketch organ_ = test::variantBlock(GetParam());
};
INSTANTIATE_TEST_SUITE_P(All, EveryModel, ::testing::ValuesIn(test::modelVariants()),
                         [](const auto& of) { return of.param.name; });

TEST_P(EveryModel, IsPressedAndComesBack) {
  const auto tissue = make();
  const Points rest = tissue->positions();
  const double most = std::sqrt(static_cast<double>(rest.cols()));
  double peak = 0.0, held = 0.0;
  int slept = 0;
  for (Visit visit; visit.time() < 3.0;) {
    const TissueStep& step = tissue->step({visit.next()}, kStep);
    ASSERT_TRUE(step.ok()) << visit.time() << " " << solver::toString(step.status);
    // Solved for or asleep, forces within the tolerance are let be.
    const bool exact = !step.slept && GetParam().isExplicit();
    EXPECT_LT(imbalance(step).norm(), exact ? 1e-9 : most * step.tolerance) << visit.time();
    EXPECT_GT(step.min_jacobian, 0.0);
    peak = std::max(peak, onTool(step).z());
    if (visit.time() < 0.4) held = onTool(step).z();
    if (visit.time() > 0.6) {
      EXPECT_TRUE(step.contacts.empty());
    }
    slept += step.slept;
  }
  EXPECT_GT(held, 0.1);
  EXPECT_GE(peak, held);
  EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), GetParam().back);
  EXPECT_GT(slept, 10);
}

// Nobody holds it: it is struck, flies, and goes on as fast.
TEST_P(EveryModel, KeepsItsMomentum) {
  if (!GetParam().has_inertia) {
    EXPECT_THROW(test::makeVariant(GetParam(), test::variantBlock(GetParam(), false),
                                   test::variantSettings()),
                 std::invalid_argument);
    return;
  }
  organ_ = test::variantBlock(GetParam(), false);
  organ_.damping = {0.0, GetParam().stiffness_damping};
  ModelSettings settings = test::variantSettings();
  settings.gravity.setZero();
  settings.tolerance = 1e-8;
  settings.position_tolerance = 0.0;
  const auto tissue = test::makeVariant(GetParam(), organ_, settings);
  Points x = tissue->positions(), v = Points::Zero(3, x.cols());
  const Vec3 middle = x.rowwise().mean();
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 r = x.col(i) - middle;
    v.col(i) = Vec3(0.02, 0.01, 0.03) + Vec3(0.3, -0.2, 0.5).cross(r) + 2.0 * r.z() * r / 0.03;
  }
  tissue->setPositions(0, x, v);
  const Points begin = tissue->positions();
  for (int k = 0; k < 40; ++k) {
    const TissueStep& step = tissue->step({}, kStep);
    ASSERT_TRUE(step.ok()) << k << " " << solver::toString(step.status);
    EXPECT_LT(step.support_force.norm(), 1e-9);
    // Of the forces of inertia the sum is what the momentum changes by.
    EXPECT_LT(step.inertia_force.norm(), 1e-6) << k;
  }
  EXPECT_GT((tissue->positions() - begin).norm(), 1e-3);
}

// Late, a step ends with what it has, and the next ones find their way.
TEST_P(EveryModel, EndsAStepWhenItIsAskedTo) {
  const auto tissue = make(), never = make();
  int asked = 0;
  const solver::Interrupt at_once = [&asked] { return ++asked > 0; };
  for (Visit visit, other; visit.time() < 1.0;) {
    const bool late = visit.time() < 0.3;
    tissue->setInterrupt(late ? &at_once : nullptr);
    const TissueStep& step = tissue->step({visit.next()}, kStep);
    const TissueStep& usual = never->step({other.next()}, kStep);
    EXPECT_TRUE(tissue->positions().allFinite());
    if (late) {
      EXPECT_LE(step.newton_iterations, std::max(10, usual.newton_iterations)) << visit.time();
    }
    if (visit.time() > 0.9) {
      EXPECT_TRUE(step.ok()) << visit.time() << " " << solver::toString(step.status);
    }
  }
  const double size = 0.06;
  EXPECT_LT((tissue->positions() - never->positions()).cwiseAbs().maxCoeff(), 0.01 * size);
}

// Asleep after cycles that were cut, it would be told as cut for good.
TEST_P(EveryModel, SaysThatItIsAtRestOnceThereIsTime) {
  const solver::Interrupt at_once = [] { return true; };
  const auto tissue = make();
  tissue->setInterrupt(&at_once);
  for (int k = 0; k < 5; ++k) tissue->step({}, kStep);
  tissue->setInterrupt(nullptr);
  for (int k = 0; k < 100; ++k) tissue->step({}, kStep);
  EXPECT_EQ(tissue->step({}, kStep).status, solver::SolveStatus::kConverged);
}

TEST_P(EveryModel, GivesTheSameBitsForAnyNumberOfThreads) {
  ThreadPool pool(3);
  const auto one = make(), three = make(&pool);
  Visit a, b;
  while (a.time() < 0.6) {
    ASSERT_EQ(onTool(one->step({a.next()}, kStep)), onTool(three->step({b.next()}, kStep)));
    ASSERT_EQ(one->positions(), three->positions());
  }
}

TEST_P(EveryModel, GoesOnFromAStateAndAfterAReset) {
  const auto whole = make(), other = make();
  for (const double until : {0.0, 0.03, 0.2, 0.45, 0.7}) {
    whole->reset();
    Visit visit;
    while (visit.time() < until) whole->step({visit.next()}, kStep);
    const State saved = whole->state();
    other->restore(saved);
    EXPECT_TRUE(other->state() == saved);
    Visit again;
    again.setTime(visit.time());
    for (int k = 0; k < 15; ++k) {
      ASSERT_EQ(onTool(whole->step({visit.next()}, kStep)),
                onTool(other->step({again.next()}, kStep)));
      ASSERT_TRUE(whole->state() == other->state()) << until << ", " << k;
    }
  }
}

// Reset while it is touched, by a tool that is another one than the next.
TEST_P(EveryModel, IsAsNewAfterAReset) {
  const auto fresh = make(), used = make();
  bool touched = false;
  for (Visit visit; visit.time() < 0.3;) {
    touched = !used->step({visit.next()}, kStep).contacts.empty();
  }
  EXPECT_TRUE(touched);
  used->reset();
  ASSERT_EQ(used->positions(), fresh->positions());
  for (Visit a, b; a.time() < 0.3;) {
    ASSERT_EQ(onTool(used->step({a.next()}, kStep)), onTool(fresh->step({b.next()}, kStep)));
    ASSERT_EQ(used->positions(), fresh->positions()) << a.time();
  }
}

}  // namespace
}  // namespace palpate::tissue::every_model_test
