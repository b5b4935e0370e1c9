// SPDX-License-Identifier: GPL-3.0-or-later
// Soft organs touch each other, and themselves where they fold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "palpate/contact/surface_contact.h"
#include "two_organs.h"

namespace palpate::tissue::organ_contact_test {
namespace {

using test::Balls;
using test::kStep;
using test::makeOrgans;
using test::OrganSketch;
using test::pushRight;
using test::twoBlocks;

const auto kFree = [](const Vec3&) { return false; };

ModelSettings settingsOf(bool self = false) {
  ModelSettings settings = test::organSettings();
  settings.interactions = interactions();
  settings.touching.self = self;
  return settings;
}

// How deep two organs, or with none `b` one, are in each other [m].
class Depth {
 public:
  Depth(const OrganSketch& a, const OrganSketch* b)
      : contact_(surface(a), b ? surface(*b) : nullptr, contact::Penalty{}) {}
  double at(const TissueModel& tissue) {
    const int n = static_cast<int>(tissue.positions(0).cols());
    const bool two = tissue.numOrgans() > 1;
    Points x(3, n + (two ? tissue.positions(1).cols() : 0));
    x.leftCols(n) = tissue.positions(0);
    if (two) x.rightCols(x.cols() - n) = tissue.positions(1);
    contact_.search(x, 1e-3);
    double deepest = 0.0;
    contact_.numTouches(x, &deepest);
    return deepest;
  }

 private:
  static std::shared_ptr<const contact::ContactSurface> surface(const OrganSketch& organ) {
    return contact::makeContactSurface(organ.mesh.points, mesh::boundaryTriangles(organ.mesh.tets));
  }
  contact::SurfaceContact contact_;
};

double kineticEnergy(const TissueModel& tissue, int organ, const Eigen::VectorXd& masses) {
  return 0.5 * tissue.velocities(organ).colwise().squaredNorm() * masses;
}

Vec3 momentOf(const Points& a, const Points& b, const Eigen::VectorXd& masses) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    sum += masses[i] * Vec3(a.col(i)).cross(Vec3(b.col(i)));
  }
  return sum;
}

// Two blocks in the air, towards each other at 0.4 m/s with a lateral offset, without damping.
// Momentum is exchanged, and energy does not grow. Backward Euler itself changes the angular
// momentum by h sum m v_(n+1) (x) v_n.
TEST(OrganContact, ExchangesMomentumAndMakesNoEnergy) {
  const Vec3 size(0.03, 0.03, 0.02);
  std::vector<OrganSketch> organs = {
      test::block("left", Vec3::Zero(), size, {3, 3, 2}, kFree),
      test::block("right", Vec3(0.04, 0.008, 0.002), size, {4, 4, 3}, kFree)};
  for (OrganSketch& organ : organs) organ.damping = {};
  ModelSettings settings = settingsOf();
  settings.gravity.setZero();
  settings.tolerance = 1e-10;
  settings.position_tolerance = 0.0;
  settings.skip.sleeping = false;
  const auto tissue = makeOrgans(organs, settings);
  std::vector<Eigen::VectorXd> masses;
  for (int k = 0; k < 2; ++k) {
    const OrganSketch& organ = organs[static_cast<std::size_t>(k)];
    masses.push_back(
        fem::makeElasticity(organ.element, organ.mesh, fem::Composition{{organ.solid}, {}, {}})
            ->masses());
    Points v = Points::Zero(3, organ.mesh.numPoints());
    v.row(0).setConstant(k == 0 ? 0.4 : -0.4);
    tissue->setPositions(k, organ.mesh.points, v);
  }
  const auto momentum = [&](int k) -> Vec3 {
    return tissue->velocities(k) * masses[static_cast<std::size_t>(k)];
  };
  const auto energy = [&] {
    return kineticEnergy(*tissue, 0, masses[0]) + kineticEnergy(*tissue, 1, masses[1]);
  };
  const Vec3 before = momentum(0) + momentum(1), left = momentum(0);
  const Vec3 spun_before = momentOf(tissue->positions(0), tissue->velocities(0), masses[0]);
  const double energy_before = energy();
  double error = 0.0, most = 0.0, spin_error = 0.0, spun = 0.0, made = 0.0, total = energy_before;
  Depth depth(organs[0], &organs[1]);
  double deepest = 0.0;
  constexpr double kShort = 0.002;
  for (int k = 0; k < 100; ++k) {
    Vec3 spin = Vec3::Zero();
    const Points v[] = {tissue->velocities(0), tissue->velocities(1)};
    for (int o = 0; o < 2; ++o) spin -= momentOf(tissue->positions(o), v[o], masses[o]);
    const TissueStep& step = tissue->step({}, kShort);
    ASSERT_TRUE(step.ok()) << solver::toString(step.status) << ' ' << k;
    for (int o = 0; o < 2; ++o) {
      spin += momentOf(tissue->positions(o), tissue->velocities(o), masses[o]);
      spin -= kShort * momentOf(tissue->velocities(o), v[o], masses[o]);
    }
    const double now = energy() + step.elastic_energy;
    made = std::max(made, now - total);
    total = now;
    error = std::max(error, (momentum(0) + momentum(1) - before).norm());
    spin_error = std::max(spin_error, spin.norm());
    most = std::max(most, (momentum(0) - left).norm());
    spun = std::max(
        spun,
        (momentOf(tissue->positions(0), tissue->velocities(0), masses[0]) - spun_before).norm());
    deepest = std::max(deepest, depth.at(*tissue));
  }
  std::printf(
      "momentum %.2e of %.3e N s, angular %.2e of %.3e N m s, energy made %.2e, left %.2e of %.2e "
      "J, depth %.2e m\n",
      error, most, spin_error, spun, made, total, energy_before, deepest);
  EXPECT_GT(most, 0.2 * left.norm());
  EXPECT_LE(error, 1e-10 * most);
  EXPECT_LE(spin_error, 1e-10 * spun);
  // Without what is stored in the contact itself.
  EXPECT_LE(made, 1e-3 * energy_before);
  EXPECT_LE(total, energy_before);
  EXPECT_LT(deepest, 1e-3);
}

// One block is pushed into the other one, which gives way: nothing passes, all balances, and a
// state from within goes on with the same bits, in scenes of either order.
TEST(OrganContact, HoldsWhileAToolPushes) {
  const std::vector<OrganSketch> blocks = twoBlocks(0.004);
  const auto tissue = makeOrgans(blocks, settingsOf());
  const auto turned = makeOrgans({blocks[1], blocks[0]}, settingsOf());
  const auto again = makeOrgans(blocks, settingsOf());
  Depth depth(blocks[0], &blocks[1]);
  double most = 0.0, deepest = 0.0;
  int k = 0;
  for (Balls balls = pushRight(0.8); balls.time() < 1.7; ++k) {
    const auto obstacles = balls.next();
    if (k == 60) again->restore(tissue->state());
    const TissueStep& step = tissue->step(obstacles, kStep);
    turned->step(obstacles, kStep);
    if (k >= 60) again->step(obstacles, kStep);
    ASSERT_TRUE(step.ok()) << solver::toString(step.status) << ' ' << k;
    ASSERT_EQ(tissue->positions(0), turned->positions(1)) << k;
    ASSERT_EQ(tissue->velocities(1), turned->velocities(0)) << k;
    if (k >= 60) {
      ASSERT_EQ(tissue->positions(1), again->positions(1)) << k;
    }
    const TissueStep &a = (*tissue->reports())[0], &b = (*tissue->reports())[1];
    for (const TissueStep& organ : {a, b}) {
      const Vec3 sum = organ.support_force + organ.gravity_force + organ.inertia_force +
                       organ.interaction_force - test::onTool(organ);
      EXPECT_LE(sum.norm(), std::sqrt(tissue->positions(0).cols()) * organ.tolerance + 1e-9);
    }
    EXPECT_LE((a.interaction_force + b.interaction_force).norm(),
              1e-10 * a.interaction_force.norm());
    most = std::max(most, a.interaction_force.norm());
    deepest = std::max(deepest, depth.at(*tissue));
  }
  EXPECT_EQ(tissue->state(), again->state());
  std::printf("force %.3f N, depth %.2e m\n", most, deepest);
  EXPECT_GT(most, 0.05);
  EXPECT_LT(deepest, 5e-4);
}

// Thrown at another one at 0.6 m/s, a block is thrown back, or lies on it.
TEST(OrganContact, StopsWhatIsThrown) {
  const auto bottom = [](const Vec3& X) { return X.z() <= 0.0; };
  const std::vector<OrganSketch> organs = {
      test::block("ground", Vec3::Zero(), Vec3(0.06, 0.06, 0.03), {5, 5, 3}, bottom),
      test::block("stone", Vec3(0.012, 0.014, 0.05), Vec3(0.03, 0.03, 0.02), {3, 3, 2}, kFree)};
  ModelSettings settings = settingsOf();
  settings.gravity.setZero();
  const auto probe = makeOrgans(organs, settings);
  Depth depth(organs[0], &organs[1]);
  Points v = Points::Zero(3, organs[1].mesh.numPoints());
  v.row(2).setConstant(-0.6);
  probe->setPositions(1, organs[1].mesh.points, v);
  double deepest = 0.0, most = 0.0, least = 1.0;
  for (int k = 0; k < 150; ++k) {
    const TissueStep& step = probe->step({}, 0.005);
    ASSERT_TRUE(step.ok()) << solver::toString(step.status) << ' ' << k;
    deepest = std::max(deepest, depth.at(*probe));
    most = std::max(most, (*probe->reports())[1].interaction_force.norm());
    least = std::min(least, probe->positions(1).row(2).minCoeff());
  }
  std::printf("force %.3f N, depth %.2e m, lowest at %.4f m\n", most, deepest, least);
  EXPECT_GT(most, 0.1);
  EXPECT_LT(deepest, 1e-3);
  EXPECT_GT(least, 0.0);
  EXPECT_TRUE(probe->positions(1).allFinite());
}

// A strip 2 mm thick, bent to a U of which the lower arm is held.
OrganSketch hairpin() {
  constexpr double kArm = 0.04, kRadius = 0.005, kThick = 0.002, kWide = 0.012;
  const double length = 2.0 * kArm + M_PI * kRadius;
  OrganSketch organ = test::block("strip", Vec3::Zero(), Vec3(length, kWide, kThick), {40, 5, 1},
                                  [](const Vec3& X) { return X.x() < 0.9 * kArm; });
  for (Eigen::Index i = 0; i < organ.mesh.numPoints(); ++i) {
    const Vec3 X = organ.mesh.points.col(i);
    const double s = X.x(), n = X.z() - 0.5 * kThick;
    Vec3 at;
    if (s < kArm) {
      at = Vec3(kArm - s, X.y(), -n);
    } else if (s < kArm + M_PI * kRadius) {
      const double turn = (s - kArm) / kRadius;
      at = Vec3(-(kRadius + n) * std::sin(turn), X.y(), kRadius - (kRadius + n) * std::cos(turn));
    } else {
      at = Vec3(s - kArm - M_PI * kRadius, X.y(), 2.0 * kRadius + n);
    }
    organ.mesh.points.col(i) = at;
  }
  return organ;
}

// A ball presses the upper arm onto the lower one, which it passes only without contact.
TEST(OrganContact, KeepsAFoldFromPassingThroughItself) {
  const OrganSketch strip = hairpin();
  double apart[2];
  for (const bool self : {false, true}) {
    ModelSettings settings = settingsOf(self);
    settings.gravity.setZero();
    const auto tissue = makeOrgans({strip}, settings);
    const auto again = makeOrgans({strip}, settings);
    Depth depth(strip, nullptr);
    double deepest = 0.0, least = 1.0;
    Balls balls;
    balls.add(Vec3(0.03, 0.006, 0.0205), -Vec3::UnitZ(), 0.27);
    for (int k = 0; k < 50; ++k) {
      const auto obstacles = balls.next();
      if (k == 24) again->restore(tissue->state());
      const TissueStep& step = tissue->step(obstacles, kStep);
      ASSERT_TRUE(step.ok()) << solver::toString(step.status) << ' ' << k << ' ' << self;
      if (k >= 24) again->step(obstacles, kStep);
      if (self) deepest = std::max(deepest, depth.at(*tissue));
      // The arms' inner sides, above each other at 30 mm.
      double lower = -1.0, upper = 1.0;
      for (Eigen::Index i = 0; i < strip.mesh.numPoints(); ++i) {
        const Vec3 X = strip.mesh.points.col(i), x = tissue->positions(0).col(i);
        if (std::abs(X.x() - 0.03) > 0.004 || std::abs(X.y() - 0.006) > 0.004) continue;
        if (X.z() > 0.0005 && X.z() < 0.0015) lower = std::max(lower, x.z());
        if (X.z() > 0.0085 && X.z() < 0.0095) upper = std::min(upper, x.z());
      }
      least = std::min(least, upper - lower);
    }
    EXPECT_EQ(again->state(), tissue->state());
    std::printf("self %d: arms apart by %.2e m at least, depth %.2e m\n", self, least, deepest);
    apart[self] = least;
    if (self) {
      EXPECT_LT(deepest, 5e-4);
    }
  }
  EXPECT_LT(apart[0], -0.5e-3);
  EXPECT_GT(apart[1], -0.2e-3);
}

// What does not fold is the same to the last bit whether or not it could.
TEST(OrganContact, LeavesAnUnfoldedOrganAsItIs) {
  const std::vector<OrganSketch> blocks = twoBlocks(0.2);
  ModelSettings off = settingsOf(), on = settingsOf(true);
  for (ModelSettings* s : {&off, &on}) s->tolerance = 1e-8, s->position_tolerance = 0.0;
  const auto a = makeOrgans({blocks[0]}, off), b = makeOrgans({blocks[0]}, on);
  double far = 0.0, moved = 0.0;
  for (Balls balls = pushRight(); balls.time() < 1.0;) {
    const auto obstacles = balls.next();
    a->step(obstacles, kStep);
    b->step(obstacles, kStep);
    far = std::max(far, (a->positions() - b->positions()).cwiseAbs().maxCoeff());
    moved = std::max(moved, (a->positions() - blocks[0].mesh.points).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(moved, 1e-3);
  EXPECT_LE(far, 1e-6 * moved);
}

}  // namespace
}  // namespace palpate::tissue::organ_contact_test
