// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that act on each other are solved as one: the same as one mesh, balanced, by every tool.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "two_organs.h"

namespace palpate::tissue::body_groups_test {
namespace {

using test::Balls;
using test::kStep;
using test::makeOrgans;
using test::organSettings;
using test::OrganSketch;
using test::pushRight;
using test::twoBlocks;

// What is asked for, tight enough to compare solutions.
ModelSettings exact(ModelSettings settings) {
  settings.tolerance = 1e-9;
  settings.position_tolerance = 0.0;
  return settings;
}

std::shared_ptr<const Interaction> withinABody(const ModelSettings&) {
  test::RepulsionSettings settings;
  settings.least_at_rest = 0.007;
  return std::make_shared<test::Repulsion>(settings);
}

// Both as one mesh, of one body, that acts on itself. With a penalty: a multiplier asks how its
// body moves as a whole.
TEST(BodyGroups, AreTheOneMeshOfBoth) {
  const std::vector<OrganSketch> blocks = twoBlocks(0.008);
  OrganSketch one = blocks[0];
  const Eigen::Index n = one.mesh.numPoints(), m = one.mesh.numTets();
  one.mesh.points.conservativeResize(3, 2 * n);
  one.mesh.points.rightCols(n) = blocks[1].mesh.points;
  one.mesh.tets.conservativeResize(4, 2 * m);
  one.mesh.tets.rightCols(m) = blocks[1].mesh.tets.array() + static_cast<int>(n);
  one.free.conservativeResize(3, 2 * n);
  one.free.rightCols(n) = blocks[1].free;
  ModelSettings settings = exact(organSettings());
  settings.contact.model = "penalty";
  ModelSettings whole = settings;
  whole.interactions = {{"within", withinABody}};
  whole.skip.islands = false;
  const auto two = makeOrgans(blocks, settings), single = makeOrgans({one}, whole);
  double most = 0.0, apart = 0.0, moved = 0.0, difference = 0.0, peak = 0.0;
  for (Balls balls = pushRight(); balls.time() < 1.3;) {
    const auto obstacles = balls.next();
    const Vec3 a = test::onTool(two->step(obstacles, kStep));
    const Vec3 b = test::onTool(single->step(obstacles, kStep));
    difference = std::max(difference, (a - b).norm());
    peak = std::max(peak, b.norm());
    const Points& x = single->positions(0);
    apart = std::max(apart, (two->positions(0) - x.leftCols(n)).cwiseAbs().maxCoeff());
    apart = std::max(apart, (two->positions(1) - x.rightCols(n)).cwiseAbs().maxCoeff());
    moved = std::max(moved, (x.rightCols(n) - blocks[1].mesh.points).cwiseAbs().maxCoeff());
    most = std::max(most, (*two->reports())[1].interaction_force.norm());
  }
  RecordProperty("difference", std::to_string(difference / peak));
  std::printf("force %.2e of %.3f N, positions %.2e of %.2e m, interaction %.3f N\n", difference,
              peak, apart, moved, most);
  EXPECT_GT(most, 0.05);
  EXPECT_GT(moved, 1e-3);
  // Both are within 1e-9 of the forces of the same equilibrium in each of 130 cycles.
  EXPECT_LE(difference, 1e-6 * peak);
  EXPECT_LE(apart, 1e-6 * moved);
}

// Two tools, one on each organ, one of them thin and fast: stages are those that both need.
TEST(BodyGroups, AreSweptByAllTools) {
  const std::vector<OrganSketch> blocks = twoBlocks(0.008);
  const auto tissue = makeOrgans(blocks, organSettings());
  const instrument::Geometry ball = instrument::Sphere{0.008}, needle = instrument::Sphere{0.002};
  int stages = 1;
  double most = 0.0;
  for (int k = 0; k < 40; ++k) {
    const auto at = [&](double s) {
      return Pose(Eigen::Translation3d(-0.016 + 0.04 * s, 0.025, 0.024));
    };
    const auto down = [&](double s) {
      return Pose(Eigen::Translation3d(0.083, 0.025, 0.036 - 0.3 * std::max(0.0, s - 0.36)));
    };
    const double t = kStep * k;
    const TissueStep& step = tissue->step(
        {{&ball, 0, at(t + 0.2), at(t + 0.2 + kStep)}, {&needle, 1, down(t), down(t + kStep)}},
        kStep);
    EXPECT_GT(step.min_jacobian, 0.0);
    stages = std::max(stages, step.sweep_stages);
    most = std::max(most, (*tissue->reports())[0].interaction_force.norm());
    for (const TissueStep& organ : *tissue->reports()) {
      const Vec3 sum = organ.support_force + organ.gravity_force + organ.inertia_force +
                       organ.interaction_force - test::onTool(organ);
      if (!organ.ok()) continue;
      EXPECT_LE(sum.norm(), std::sqrt(blocks[0].mesh.numPoints()) * organ.tolerance + 1e-9);
    }
    // They feel the same cycle, in stages and in parts.
    EXPECT_EQ((*tissue->reports())[0].time_steps, (*tissue->reports())[1].time_steps);
  }
  EXPECT_GT(stages, 1);
  EXPECT_GT(most, 0.0);
}

// Repulsion that has no energy until a step was taken back so often.
class FussyTerm final : public InteractionTerm {
 public:
  FussyTerm(const InteractingBody& a, const InteractingBody& b, int refusals)
      : inner_(a, b, test::RepulsionSettings()), refusals_(refusals) {}
  void search(const Points& x, double way) override { inner_.search(x, way); }
  bool holds(const Points& x) const override { return inner_.holds(x); }
  double value(const Points& x) const override {
    return refusals_ > 0 ? std::nan("") : inner_.value(x);
  }
  double addGradient(const Points& x, Points* g) const override {
    inner_.addGradient(x, g);
    return value(x);
  }
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override {
    inner_.addHessian(x, tangent, K);
  }
  void restore(StateReader*) override { --refusals_; }

 private:
  test::RepulsionTerm inner_;
  int refusals_;
};

template <int refusals>
class Fussy final : public Interaction {
 public:
  bool possible(const InteractingBody& a, const InteractingBody& b) const override {
    return &a != &b && boxesOverlap(a, b, test::RepulsionSettings().reach);
  }
  std::unique_ptr<InteractionTerm> make(const InteractingBody& a,
                                        const InteractingBody& b) const override {
    return std::make_unique<FussyTerm>(a, b, refusals);
  }
};

template <int refusals>
std::shared_ptr<const Interaction> fussy(const ModelSettings&) {
  return std::make_shared<Fussy<refusals>>();
}

// In one and in two steps nothing is found, in four it is: by all members.
TEST(BodyGroups, AreTriedAgainAsAWhole) {
  ModelSettings settings = organSettings();
  settings.interactions = {{"fussy", fussy<2>}};
  const auto tissue = makeOrgans(twoBlocks(0.005), settings),
             usual = makeOrgans(twoBlocks(0.005), organSettings());
  const Points start = tissue->positions(0);
  EXPECT_TRUE(tissue->step({}, kStep).ok());
  for (const TissueStep& organ : *tissue->reports()) EXPECT_EQ(organ.time_steps, 4);
  EXPECT_EQ(tissue->step({}, kStep).time_steps, 1);
  for (int k = 0; k < 5; ++k) usual->step({}, k < 4 ? 0.25 * kStep : kStep);
  const double moved = (usual->positions(0) - start).cwiseAbs().maxCoeff();
  EXPECT_LE((tissue->positions(0) - usual->positions(0)).cwiseAbs().maxCoeff(), 1e-2 * moved);
  EXPECT_LE((tissue->positions(1) - usual->positions(1)).cwiseAbs().maxCoeff(), 1e-2 * moved);
}

TEST(BodyGroups, StandStillTogetherWhereNothingIsFound) {
  ModelSettings settings = organSettings();
  settings.interactions = {{"fussy", fussy<1000>}};
  const auto tissue = makeOrgans(twoBlocks(0.005), settings);
  const Points x = tissue->positions(0), y = tissue->positions(1);
  Balls balls = pushRight();
  EXPECT_EQ(tissue->step(balls.next(), kStep).status, solver::SolveStatus::kNonFinite);
  for (const TissueStep& organ : *tissue->reports()) {
    EXPECT_EQ(organ.time_steps, 8);
    EXPECT_EQ(organ.status, solver::SolveStatus::kNonFinite);
    EXPECT_TRUE(organ.contacts.empty());
  }
  EXPECT_EQ(tissue->positions(0), x);
  EXPECT_EQ(tissue->positions(1), y);
  EXPECT_TRUE(tissue->velocities(0).isZero(0.0) && tissue->velocities(1).isZero(0.0));
}

TEST(BodyGroups, SleepWhenAllMembersAreStillAndApartFromOthers) {
  std::vector<OrganSketch> organs = twoBlocks(0.005);  // they touch at rest
  organs.push_back(organs[1]);
  organs[2].name = "third";
  organs[2].mesh.points.row(0).array() += 0.3;
  const auto tissue = makeOrgans(organs, organSettings());
  const auto slept = [&](int k) { return (*tissue->reports())[static_cast<std::size_t>(k)].slept; };
  int cycles = 0;
  do {
    tissue->step({}, kStep);
    EXPECT_EQ(slept(0), slept(1));
  } while (!slept(0) && ++cycles < 1000);
  EXPECT_TRUE(slept(0));
  EXPECT_GT((*tissue->reports())[0].interaction_force.norm(), 0.0);  // they lean on each other
  // The third one is pressed: the pair sleeps on. Then the left one: the right one wakes with it.
  Balls third, left = pushRight();
  third.add(Vec3(0.38, 0.025, 0.048), -Vec3::UnitZ(), 0.4);
  bool pressed = false;
  for (int k = 0; k < 40; ++k) {
    tissue->step(third.next(), kStep);
    EXPECT_TRUE(slept(0) && slept(1));
    pressed = pressed || !slept(2);
  }
  EXPECT_TRUE(pressed);
  bool woke = false;
  for (int k = 0; k < 60; ++k) {
    tissue->step(left.next(), kStep);
    EXPECT_EQ(slept(0), slept(1));
    woke = woke || !slept(1);
  }
  EXPECT_TRUE(woke);
}

}  // namespace
}  // namespace palpate::tissue::body_groups_test
