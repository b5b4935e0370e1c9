// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/local_model.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace palpate::haptics::local_model_test {
namespace {

// Springs that push the tool up: 300 N/m along z, 120 and 150 aside, with a couple between.
const Mat3 kStiffness = (Mat3() << 120, 10, 20, 10, 150, -15, 20, -15, 300).finished();
const Vec3 kForce(0.1, -0.2, 2.0);

Wrench spring(const Vec3& p) {
  Wrench wrench;
  wrench.force = kForce - kStiffness * p;
  wrench.torque = Vec3(0.01, 0.02, 0.0).cross(wrench.force);
  return wrench;
}

std::mt19937 rng{5};
Vec3 somewhere(double size) {
  std::uniform_real_distribution<double> u(-size, size);
  return {u(rng), u(rng), u(rng)};
}

TEST(LocalModel, FindsTheStiffnessFromMotionsInAllDirections) {
  LocalModelSettings settings;
  settings.noise = 1e-7;
  LocalModel local(settings);
  for (int k = 0; k < 60; ++k) {
    const Vec3 p = somewhere(1e-3);
    local.observe(p, spring(p));
  }
  EXPECT_LT((local.model().stiffness_W - kStiffness).norm(), 1e-3 * kStiffness.norm());
  const Vec3 p = somewhere(1e-3);
  EXPECT_LT((local.model().at(p).force - spring(p).force).norm(), 1e-4);
  EXPECT_LT((local.model().at(p).torque - spring(p).torque).norm(), 1e-4);
}

TEST(LocalModel, IsExactWhereItWasSolved) {
  LocalModel local;
  for (int k = 0; k < 20; ++k) {
    const Vec3 p = somewhere(1e-3);
    const ContactModel& model = local.observe(p, spring(p));
    EXPECT_EQ(model.at(p).force, spring(p).force);
    EXPECT_LT((model.at(p).torque - spring(p).torque).norm(), 1e-15);
  }
}

// Straight down: two solves are enough along the way.
TEST(LocalModel, KnowsTheWayThatTheToolGoesAfterTwoSolves) {
  LocalModel local;
  for (int k = 0; k < 3; ++k) local.observe(Vec3(0, 0, -1e-3 * k), spring(Vec3(0, 0, -1e-3 * k)));
  const Vec3 p(0, 0, -2.7e-3);
  EXPECT_LT((local.model().at(p).force - spring(p).force).norm(), 0.01);
}

TEST(LocalModel, NeverDrawsTheToolIn) {
  LocalModel local;
  for (int k = 0; k < 60; ++k) {
    const Vec3 p = somewhere(1e-3);
    local.observe(p, spring(p));
  }
  for (double up = 0.0; up < 0.02; up += 1e-4) {
    const Wrench wrench = local.model().at(Vec3(0, 0, up));
    EXPECT_GE(wrench.force.dot(local.model().wrench.force), 0.0);
    if (up > 0.012) {
      EXPECT_EQ(wrench.force.norm() == 0.0, local.model().wrench.force.z() < 300 * 0.005) << up;
    }
  }
}

TEST(LocalModel, IsPassiveAndLimitedWhateverItIsTold) {
  LocalModelSettings settings;
  settings.max_stiffness = 1000.0;
  LocalModel local(settings);
  for (int k = 0; k < 1000; ++k) {
    local.observe(somewhere(1e-3), {somewhere(5.0), somewhere(0.1)});
    const Mat3& K = local.model().stiffness_W;
    EXPECT_LT((K - K.transpose()).norm(), 1e-12 * K.norm() + 1e-300);
    const Vec3 values = Eigen::SelfAdjointEigenSolver<Mat3>(K).eigenvalues();
    EXPECT_GE(values.minCoeff(), -1e-9);
    EXPECT_LE(values.maxCoeff(), 1000.0 + 1e-9);
  }
}

TEST(LocalModel, AToolAtRestTeachesNothing) {
  LocalModel local;
  for (int k = 0; k < 60; ++k) {
    const Vec3 p = somewhere(1e-3);
    local.observe(p, spring(p));
  }
  const Mat3 before = local.model().stiffness_W;
  // The tissue relaxes under a tool that trembles by a tenth of a micrometre.
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = somewhere(1e-7);
    Wrench wrench = spring(p);
    wrench.force.z() -= 1e-3 * k;
    local.observe(p, wrench);
  }
  EXPECT_LT((local.model().stiffness_W - before).norm(), 0.05 * before.norm());
}

TEST(LocalModel, BeginsAnewAtATouchFarAway) {
  LocalModel local;
  for (int k = 0; k < 20; ++k) {
    const Vec3 p = somewhere(1e-3);
    local.observe(p, spring(p));
  }
  local.observe(Vec3(0, 0, 0.1), {});
  EXPECT_EQ(local.model().at(Vec3(0, 0, -1)).force, Vec3::Zero());
  // 2 N after 10 mm: no more than 200 N/m, along the force.
  local.observe(Vec3(0, 0, 0.01), {});
  local.observe(Vec3::Zero(), spring(Vec3::Zero()));
  const Vec3 normal = kForce.normalized();
  const double stiffness = kForce.norm() / (0.01 * normal.z());
  EXPECT_LT((local.model().stiffness_W - stiffness * normal * normal.transpose()).norm(), 1e-9);
}

// A tool in and out of a surface at z = 0.
Wrench surface(const Vec3& p) { return {Vec3(0, 0, std::max(0.0, -500.0 * p.z())), Vec3::Zero()}; }
LocalModel touched(double up) {
  LocalModel local;
  for (const double z : {0.004, 0.002, -0.001, -0.002, -0.003, -0.002, -0.001, 0.001, up}) {
    local.observe(Vec3(0, 0, z), surface(Vec3(0, 0, z)));
  }
  return local;
}

TEST(LocalModel, ExpectsAContactWhereItEnded) {
  const LocalModel local = touched(0.01);
  EXPECT_EQ(local.model().at(Vec3(0, 0, 1e-5)).force, Vec3::Zero());
  for (const double z : {-0.001, -0.002, -0.004}) {
    EXPECT_NEAR(local.model().at(Vec3(0, 0, z)).force.z(), -500.0 * z, 0.01 - 10.0 * z) << z;
  }
}

// Tissue that came back after the tool left is met a little before it is expected: a short way
// since says nothing of its stiffness.
TEST(LocalModel, KeepsTheStiffnessOfAContactThatComesBackElsewhere) {
  for (const double earlier : {-2e-5, 2e-5, 1e-4, 3e-4}) {
    LocalModel local = touched(0.01);
    const double K = local.model().stiffness_W(2, 2);
    Wrench wrench;
    wrench.force.z() = 0.05;
    local.observe(Vec3(0, 0, earlier), wrench);
    EXPECT_NEAR(local.model().stiffness_W(2, 2), K, 1e-9 * K) << earlier;
  }
}

TEST(LocalModel, ExpectsNoneAsideOrFarAway) {
  EXPECT_EQ(touched(0.06).model().wrench.force, Vec3::Zero());
  LocalModel local = touched(0.002);
  local.observe(Vec3(0.006, 0, 0.002), {});
  EXPECT_EQ(local.model().at(Vec3(0.006, 0, -0.01)).force, Vec3::Zero());
}

// The tissue has gone: the tool goes down where it was, 0.5 mm a solve.
TEST(LocalModel, GivesUpAContactThatDoesNotCome) {
  LocalModel local = touched(0.001);
  for (int k = 0; k < 8; ++k) local.observe(Vec3(0, 0, -5e-4 * k), {});
  EXPECT_EQ(local.model().at(Vec3(0, 0, -0.02)).force, Vec3::Zero());
  // Nor does it stay for a tool that rests on it.
  local = touched(0.001);
  for (int k = 0; k < 8; ++k) local.observe(local.model().p_W, {});
  EXPECT_EQ(local.model().at(Vec3(0, 0, -0.02)).force, Vec3::Zero());
}

}  // namespace
}  // namespace palpate::haptics::local_model_test
