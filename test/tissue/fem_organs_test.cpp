// SPDX-License-Identifier: GPL-3.0-or-later
// Organs of one model: apart they are as if alone, and who may touch whom.
#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/tissue/skips.h"
#include "support/contains.h"
#include "two_organs.h"

namespace palpate::tissue::fem_organs_test {
namespace {

using test::Balls;
using test::kStep;
using test::makeOrgans;
using test::organSettings;
using test::OrganSketch;
using test::pushRight;
using test::twoBlocks;

void expectSameFigures(const TissueStep& a, const TissueStep& b) {
  for (const Figure<StepFigures>& figure : stepFigures()) {
    std::visit([&](auto member) { EXPECT_EQ(a.*member, b.*member) << figure.name; }, figure.value);
  }
  for (const Skip& skip : skips()) {
    if (skip.count == &SkipCounters::apart_organs) continue;
    EXPECT_EQ(skip.of(a), skip.of(b)) << skip.doc;
  }
}

// One is pressed, the other sleeps.
TEST(FemOrgans, FarApartAreAsModelsOfTheirOwn) {
  const std::vector<OrganSketch> blocks = twoBlocks(0.2);
  const auto both = makeOrgans(blocks, organSettings());
  ModelSettings alone = organSettings();
  alone.interactions.clear();
  const auto left = makeOrgans({blocks[0]}, alone), right = makeOrgans({blocks[1]}, alone);
  ASSERT_EQ(both->numOrgans(), 2);
  int slept = 0, touched = 0;
  for (Balls balls = pushRight(); balls.time() < 1.3;) {
    const auto obstacles = balls.next();
    both->step(obstacles, kStep);
    const TissueStep& a = left->step(obstacles, kStep);
    const TissueStep& b = right->step(obstacles, kStep);
    ASSERT_EQ(both->positions(0), left->positions());
    ASSERT_EQ(both->positions(1), right->positions());
    ASSERT_EQ(both->velocities(0), left->velocities());
    expectSameFigures((*both->reports())[0], a);
    expectSameFigures((*both->reports())[1], b);
    EXPECT_EQ((*both->reports())[0].apart_organs + (*both->reports())[1].apart_organs, 1);
    slept += b.slept;
    touched += !a.contacts.empty();
  }
  EXPECT_GT(slept, 100);
  EXPECT_GT(touched, 30);
}

// Pushed into the other one, which then moves; a figure of both is merged by its rule.
TEST(FemOrgans, AreReportedOrganByOrganAndTogether) {
  const auto tissue = makeOrgans(twoBlocks(0.008), organSettings());
  const Eigen::Index nodes = tissue->positions(0).cols();
  double most = 0.0;
  int together = 0;
  Balls balls = pushRight();
  balls.add(Vec3(0.083, 0.025, 0.05), -Vec3::UnitZ(), 0.6);
  for (int k = 0; k < 120; ++k) {
    const TissueStep& all = tissue->step(balls.next(), kStep);
    ASSERT_TRUE(all.ok()) << solver::toString(all.status);
    const TissueStep &a = (*tissue->reports())[0], &b = (*tissue->reports())[1];
    EXPECT_EQ(all.newton_iterations, a.newton_iterations + b.newton_iterations);
    EXPECT_EQ(all.residual, std::max(a.residual, b.residual));
    EXPECT_EQ(all.min_jacobian, std::min(a.min_jacobian, b.min_jacobian));
    EXPECT_EQ(all.contacts.size(), a.contacts.size() + b.contacts.size());
    for (const TissueContact& c : all.contacts) EXPECT_EQ(c.organ, c.owner.index);
    for (const TissueStep& organ : {a, b}) {
      const Vec3 sum = organ.support_force + organ.gravity_force + organ.inertia_force +
                       organ.interaction_force - test::onTool(organ);
      EXPECT_LE(sum.norm(), std::sqrt(nodes) * organ.tolerance + 1e-9);
    }
    EXPECT_LE((a.interaction_force + b.interaction_force).norm(),
              1e-10 * a.interaction_force.norm());
    most = std::max(most, a.interaction_force.norm());
    together += a.apart_organs == 0;
  }
  EXPECT_GT(most, 0.05);
  EXPECT_GT(together, 20);
}

// The order of a scene's organs is nobody's business.
TEST(FemOrgans, OfAnotherOrderMoveAlikeToTheLastBit) {
  std::vector<OrganSketch> organs = twoBlocks(0.008);
  organs.push_back(organs[1]);
  organs[2].name = "far";
  organs[2].mesh.points.row(0).array() += 0.058;
  const auto forward = makeOrgans(organs, organSettings());
  const auto turned = makeOrgans({organs[2], organs[0], organs[1]}, organSettings());
  const int place[] = {1, 2, 0};
  double most = 0.0;
  for (Balls balls = pushRight(); balls.time() < 1.3;) {
    const auto obstacles = balls.next();
    const TissueStep& a = forward->step(obstacles, kStep);
    const TissueStep& b = turned->step(obstacles, kStep);
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(forward->positions(k), turned->positions(place[k])) << k;
      ASSERT_EQ(forward->velocities(k), turned->velocities(place[k])) << k;
    }
    // Sums over organs are taken in the scene's order.
    EXPECT_NEAR(a.elastic_energy, b.elastic_energy, 1e-12 * a.elastic_energy);
    EXPECT_LE((test::onTool(a) - test::onTool(b)).norm(), 1e-12 * test::onTool(a).norm());
    most = std::max(most, (*forward->reports())[0].interaction_force.norm());
  }
  EXPECT_GT(most, 0.05);
}

TEST(FemOrgans, ThatAreToldApartPassEachOther) {
  const std::vector<OrganSketch> blocks = twoBlocks(0.008);
  ModelSettings none = organSettings(), apart = none, off = none;
  none.interactions.clear();
  apart.touching.apart = {{"right", "left"}};
  off.touching.organs = false;
  const auto tissue = makeOrgans(blocks, none), a = makeOrgans(blocks, apart),
             b = makeOrgans(blocks, off);
  for (Balls balls = pushRight(); balls.time() < 0.8;) {
    const auto obstacles = balls.next();
    tissue->step(obstacles, kStep);
    for (TissueModel* other : {a.get(), b.get()}) {
      other->step(obstacles, kStep);
      ASSERT_EQ(tissue->positions(0), other->positions(0));
      EXPECT_EQ((*other->reports())[0].apart_organs, 0);  // nobody had to look
    }
  }
  EXPECT_TRUE(TouchingOrgans().mayTouch("left", "right"));
  EXPECT_FALSE(apart.touching.mayTouch("left", "right"));
  EXPECT_TRUE(apart.touching.mayTouch("left", "left"));
}

// What is left out, done all the same: one group, all the time.
TEST(FemOrgans, ThatCannotActAreTheSameWhenSolvedTogether) {
  ModelSettings on = organSettings(), off = on;
  on.tolerance = off.tolerance = 1e-8;
  on.position_tolerance = off.position_tolerance = 0.0;
  off.skip.apart_organs = false;
  const auto a = makeOrgans(twoBlocks(0.03), on), b = makeOrgans(twoBlocks(0.03), off);
  double far = 0.0, moved = 0.0;
  for (Balls balls = pushRight(); balls.time() < 0.8;) {
    const auto obstacles = balls.next();
    a->step(obstacles, kStep);
    b->step(obstacles, kStep);
    EXPECT_EQ((*b->reports())[0].apart_organs, 0);
    far = std::max(far, (a->positions(0) - b->positions(0)).cwiseAbs().maxCoeff());
    moved = std::max(moved, (a->positions(0) - a->cells(0).points).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(moved, 0.005);
  EXPECT_LE(far, 1e-6 * moved);
}

// A method without a motion to lend is let be, and says so.
TEST(FemOrgans, SolvedByAnotherKindOfMethodAreSaidToPass) {
  ModelSettings settings = organSettings();
  settings.method = "tled";
  const auto tissue = makeOrgans(twoBlocks(0.008), settings);
  const std::vector<std::string> notes = tissue->notes();
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_TRUE(test::contains(notes[0], "organ left: method tled solves organs one by one"))
      << notes[0];
  for (Balls balls = pushRight(); balls.time() < 0.3;) {
    tissue->step(balls.next(), kStep);
    EXPECT_EQ((*tissue->reports())[0].interaction_force, Vec3::Zero());
  }
}

TEST(FemOrgans, SayWhichOfThemIsNotHeld) {
  std::vector<OrganSketch> blocks = twoBlocks(0.008);
  blocks[1].free.setOnes();
  try {
    makeOrgans(blocks, organSettings());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::contains(error.what(), "organ right: gravity would move the body"))
        << error.what();
  }
}

}  // namespace
}  // namespace palpate::tissue::fem_organs_test
