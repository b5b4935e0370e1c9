// SPDX-License-Identifier: GPL-3.0-or-later
// Groups go on from a state with the same bits, also in the middle of a contact, and whatever the
// mesh of a member becomes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

#include "palpate/solver/integrator.h"
#include "palpate/solver/minimizer_list.h"
#include "two_organs.h"

namespace palpate::tissue::group_memory_test {
namespace {

using test::Balls;
using test::kStep;
using test::makeOrgans;
using test::organSettings;
using test::OrganSketch;
using test::pushRight;
using test::twoBlocks;

struct Kind {
  const char *method, *integrator;
  bool viscous, bonds;
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.method << ' ' << kind.integrator << (kind.viscous ? " viscous" : "")
       << (kind.bonds ? " bonds" : "");
}

class GroupMemory : public ::testing::TestWithParam<Kind> {
 protected:
  ModelSettings settings() const {
    ModelSettings made = organSettings();
    made.method = GetParam().method;
    made.integrator = GetParam().integrator;
    if (GetParam().bonds) made.interactions = {test::repulsion<50>()};
    return made;
  }
  std::vector<OrganSketch> blocks() const {
    std::vector<OrganSketch> made = twoBlocks(0.008);
    made[0].damping.stiffness = 0.002;
    if (GetParam().viscous) made[0].solid.prony = {{0.4, 0.1}};
    return made;
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, GroupMemory,
                         ::testing::Values(Kind{"implicit_pcg", "backward_euler", false, false},
                                           Kind{"implicit_pcg", "bdf2", false, true},
                                           Kind{"implicit_pcg", "backward_euler", true, true},
                                           Kind{"implicit_direct", "backward_euler", false, false},
                                           Kind{"implicit_async", "static", false, false},
                                           Kind{"lbfgs", "bdf2", true, false}));

// A state from every part of the way: alone, together, and alone again.
TEST_P(GroupMemory, GoesOnFromAStateToTheLastBit) {
  ThreadPool pool(2);
  const auto tissue = makeOrgans(blocks(), settings());
  const auto again = makeOrgans(blocks(), settings(), &pool);
  double most = 0.0;
  int together = 0;
  for (int begin = 0; begin < 130; begin += 13) {
    again->restore(tissue->state());
    EXPECT_EQ(again->state(), tissue->state());
    Balls a = pushRight(), b = a;
    a.setTime(kStep * begin);
    b.setTime(kStep * begin);
    for (int k = 0; k < 13; ++k) {
      const TissueStep& step = tissue->step(a.next(), kStep);
      again->step(b.next(), kStep);
      ASSERT_EQ(tissue->positions(0), again->positions(0)) << begin + k;
      ASSERT_EQ(tissue->positions(1), again->positions(1)) << begin + k;
      ASSERT_EQ(tissue->velocities(1), again->velocities(1)) << begin + k;
      EXPECT_TRUE(step.ok()) << solver::toString(step.status);
      most = std::max(
          most, step.contacts.empty() ? 0.0 : (*tissue->reports())[1].interaction_force.norm());
      together += (*tissue->reports())[0].apart_organs == 0;
    }
    EXPECT_EQ(again->state(), tissue->state());
  }
  EXPECT_GT(most, 0.05);
  EXPECT_GT(together, 20);
}

TEST_P(GroupMemory, BeginsAnewAfterAReset) {
  const auto tissue = makeOrgans(blocks(), settings()), fresh = makeOrgans(blocks(), settings());
  for (Balls balls = pushRight(); balls.time() < 0.6;) tissue->step(balls.next(), kStep);
  tissue->reset();
  for (Balls a = pushRight(), b = pushRight(); a.time() < 0.8;) {
    tissue->step(a.next(), kStep);
    fresh->step(b.next(), kStep);
    ASSERT_EQ(tissue->positions(1), fresh->positions(1));
  }
  EXPECT_EQ(tissue->state(), fresh->state());
}

ModelSettings failingWhereTheyMeet() {
  ModelSettings settings = organSettings();
  settings.gravity.setZero();
  settings.interactions = {{"repulsion", [](const ModelSettings&) {
                              test::RepulsionSettings none;  // no energy
                              none.stiffness = std::numeric_limits<double>::quiet_NaN();
                              return std::shared_ptr<const Interaction>(new test::Repulsion(none));
                            }}};
  return settings;
}

// What fails together is tried again together: as soon as the tool that touches one of them is
// gone, though the other one was never touched, and at the same time later on.
TEST(FrozenGroup, IsTriedAgainWhenTheToolOfOneHasLeft) {
  const auto tissue = makeOrgans(twoBlocks(0.008), failingWhereTheyMeet());
  const auto isFrozen = [&tissue](std::size_t organ) {
    return (*tissue->reports())[organ].recovery == static_cast<int>(Recovery::kFrozen);
  };
  int frozen = 0, apart = 0;
  for (Balls balls = pushRight(0.9); frozen < 20 && balls.time() < 0.9;) {
    tissue->step(balls.next(), kStep);
    EXPECT_EQ(isFrozen(0), isFrozen(1)) << balls.time();
    frozen += isFrozen(0);
    if (!isFrozen(1)) continue;
    apart += (*tissue->reports())[0].apart_organs > 0;
    EXPECT_FALSE((*tissue->reports())[1].ok());
  }
  EXPECT_EQ(frozen, 20);
  EXPECT_EQ(apart, 0);
  tissue->step({}, kStep);
  for (const std::size_t organ : {0u, 1u}) {
    EXPECT_FALSE(isFrozen(organ));
    EXPECT_TRUE((*tissue->reports())[organ].ok());
  }
}

// One that was placed into the other one: no tool will leave, and no cycle leads out.
TEST(FrozenGroup, IsPutBackWhereItFailsForGood) {
  const auto tissue = makeOrgans(twoBlocks(0.008), failingWhereTheyMeet());
  const Points rest[] = {tissue->positions(0), tissue->positions(1)};
  Points x = rest[0];
  x.row(0).array() += 0.01;
  tissue->setPositions(0, x, Points::Zero(3, x.cols()));
  int put_back = 0;
  for (int k = 0; k < 80; ++k) {
    tissue->step({}, kStep);
    const std::vector<TissueStep>& reports = *tissue->reports();
    EXPECT_EQ(reports[0].recovery, reports[1].recovery) << k;
    if (reports[0].recovery != static_cast<int>(Recovery::kPutBack)) continue;
    ++put_back;
    for (const std::size_t organ : {0u, 1u}) {
      EXPECT_FALSE(reports[organ].ok());
      EXPECT_EQ(tissue->positions(static_cast<int>(organ)), rest[organ]);
    }
  }
  EXPECT_EQ(put_back, 1);
  EXPECT_TRUE((*tissue->reports())[0].ok());
}

TEST(GroupState, OfOtherOrgansIsRefused) {
  const auto tissue = makeOrgans(twoBlocks(0.008), organSettings());
  const State state = tissue->state();
  const auto finer = makeOrgans(twoBlocks(0.008, 2), organSettings());
  EXPECT_THROW(finer->restore(state), std::invalid_argument);
  State cut = state;
  cut.bytes.resize(cut.bytes.size() - 1);
  EXPECT_THROW(tissue->restore(cut), std::invalid_argument);
  tissue->restore(state);
  EXPECT_EQ(tissue->state(), state);
}

// The left one becomes finer where the ball is, within the contact, and coarse again; what the two
// remember of each other stays with the nodes that stay.
TEST(GroupMesh, BecomesAnotherWithinAContact) {
  std::vector<OrganSketch> blocks = twoBlocks(0.008);
  blocks[0].adapt.finest = 0.006;
  ModelSettings settings = organSettings();
  settings.gravity.setZero();
  settings.interactions = {test::repulsion<50>()};
  const auto tissue = makeOrgans(blocks, settings), again = makeOrgans(blocks, settings);
  int changes = 0, in_contact = 0;
  double most = 0.0, before = 0.0, leap = 0.0;
  Balls balls = pushRight();
  balls.add(Vec3(0.025, 0.025, 0.07), -Vec3::UnitZ(), 0.7);
  for (int k = 0; k < 140; ++k) {
    const std::uint64_t revision = tissue->surfaceState(0).revision;
    const auto obstacles = balls.next();
    const TissueStep& step = tissue->step(obstacles, kStep);
    again->step(obstacles, kStep);
    ASSERT_TRUE(step.ok()) << solver::toString(step.status) << ' ' << k;
    ASSERT_EQ(tissue->positions(0), again->positions(0));
    const bool changed = tissue->surfaceState(0).revision != revision;
    const double force = (*tissue->reports())[1].interaction_force.norm();
    changes += changed;
    in_contact += changed && force > 0.01;
    if (changed && force > 0.01) leap = std::max(leap, std::abs(force - before));
    for (const TissueStep& organ : *tissue->reports()) {
      const Vec3 sum = organ.support_force + organ.gravity_force + organ.inertia_force +
                       organ.interaction_force - test::onTool(organ);
      EXPECT_LE(sum.norm(), std::sqrt(tissue->positions(0).cols()) * organ.tolerance + 1e-9);
    }
    before = force;
    most = std::max(most, force);
    if (k == 70) again->restore(tissue->state());
  }
  std::printf("%d changes, %d in contact, force up to %.3f N, leap %.4f N\n", changes, in_contact,
              most, leap);
  EXPECT_GT(in_contact, 0);
  EXPECT_GT(most, 0.05);
  // A finer surface has more nodes that push: half as many again at most, of those near the ball.
  EXPECT_LT(leap, 0.5 * most);
}

}  // namespace
}  // namespace palpate::tissue::group_memory_test
