// SPDX-License-Identifier: GPL-3.0-or-later
#include "tissue/adaptation/adaptive_tissue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

#include "adaptive_slab.h"
#include "support/hold_response.h"

namespace palpate::tissue::adaptive_tissue_test {
namespace {

using test::AdaptiveSlab;
using test::Ball;
using test::onTool;
using test::Press;
constexpr double kStep = test::kStep;

// Of every kind of element that there is a mesh for.
class AdaptiveTissue : public ::testing::TestWithParam<const char*> {
 protected:
  // Quadratic elements are as good with edges of about twice the length.
  static AdaptiveSlab slabFor(double finest = 0.005) {
    AdaptiveSlab slab(GetParam());
    slab.adapt.finest = slab.mesh.quadratic() ? 2.0 * finest : finest;
    return slab;
  }
};

double areaOf(const SurfaceState& shape) {
  double sum = 0.0;
  for (Eigen::Index t = 0; t < shape.triangles.cols(); ++t) {
    const Vec3 a = shape.positions.col(shape.triangles(0, t));
    const Vec3 b = shape.positions.col(shape.triangles(1, t));
    const Vec3 c = shape.positions.col(shape.triangles(2, t));
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

TEST_P(AdaptiveTissue, IsRefinedBeforeAToolTouchesAndJoinedBehindIt) {
  const auto tissue = slabFor().make();
  const Eigen::Index coarse = tissue->positions().cols();
  const double area = areaOf(tissue->surfaceState(0));
  std::uint64_t revision = tissue->surfaceState(0).revision;
  Ball ball(Vec3(0.05, 0.05, 0.2));
  Eigen::Index most = 0;
  bool touched = false;
  for (int k = 0; k <= 400; ++k) {
    const double way = 0.2 - 0.001 * std::min(k, 155) + 0.001 * std::max(0, k - 245);
    const TissueStep& step = tissue->step(ball.to(Vec3(0.05, 0.05, way)), kStep);
    const SurfaceState shape = tissue->surfaceState(0);
    ASSERT_EQ(shape.velocities.cols(), shape.positions.cols());
    ASSERT_LT(shape.triangles.maxCoeff(), shape.positions.cols());
    if (shape.positions.cols() != most) {
      EXPECT_GE(shape.revision, revision);
    }
    revision = shape.revision;
    if (k == 5) {
      EXPECT_EQ(shape.positions.cols(), coarse);  // far away
    }
    if (!touched && !step.contacts.empty()) {
      touched = true;
      EXPECT_GT(shape.positions.cols(), coarse + coarse / 4);
    }
    most = std::max(most, shape.positions.cols());
  }
  EXPECT_TRUE(touched);
  EXPECT_EQ(tissue->positions().cols(), coarse);
  EXPECT_NEAR(areaOf(tissue->surfaceState(0)), area, 1e-3 * area);
}

// What the hand feels when a mesh changes that the tool presses: the ball rests, and then a second
// one comes near, whose mesh is made and thrown away.
TEST_P(AdaptiveTissue, HardlyMovesTheForceWhereTheMeshChangesElsewhere) {
  for (const bool viscous : {false, true}) {
    AdaptiveSlab slab = slabFor();
    if (slab.mesh.quadratic() && !viscous) continue;  // slow
    if (viscous) slab.composition.solids[0].prony = {{0.4, 0.3}};
    const auto alone = slab.make(), beside = slab.make();
    Ball ball(Vec3(0.03, 0.05, 0.052)), same(Vec3(0.03, 0.05, 0.052));
    Ball other(Vec3(0.2, 0.05, 0.06));
    std::uint64_t changes = 0;
    for (int k = 0; k < 160; ++k) {
      const Vec3 at(0.03, 0.05, 0.052 - 0.0002 * std::min(k, 40));
      const Vec3 near(std::abs(0.2 - 0.0025 * k) + 0.075, 0.05, 0.06);
      const auto far = other.to(near)[0];
      const std::uint64_t before = beside->surfaceState(0).revision;
      const Vec3 expected = onTool(alone->step(ball.to(at), kStep));
      const Vec3 force = onTool(beside->step({same.to(at)[0], far}, kStep));
      changes += beside->surfaceState(0).revision - before;
      if (k > 45) {
        EXPECT_LT((force - expected).norm(), 0.01 * expected.norm()) << k << " " << viscous;
      }
    }
    EXPECT_GT(changes, 10u);
  }
}

TEST_P(AdaptiveTissue, RestsAtTheForceOfTheMeshThatItBecomes) {
  AdaptiveSlab slab = slabFor();
  slab.settings.integrator = "static";
  const auto adaptive = slab.make();
  Ball ball(Vec3(0.05, 0.05, 0.06));
  Vec3 force;
  for (int k = 0; k < 60; ++k) {
    force =
        onTool(adaptive->step(ball.to(Vec3(0.05, 0.05, 0.06 - 0.0004 * std::min(k, 40))), kStep));
  }
  // The same mesh from the beginning.
  const mesh::CellMesh cells = adaptive->cells(0);
  mesh::TetMesh mesh;
  mesh.points = cells.points;
  mesh.tets = cells.cells.topRows(4);
  if (slab.mesh.quadratic()) mesh.midnodes = cells.cells.bottomRows(6);
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    if (mesh.points(2, i) == 0.0) free.col(i).setZero();
  }
  const auto fixed = makeFemTissue(mesh, slab.composition, free, slab.settings);
  Ball again(Vec3(0.05, 0.05, 0.06));
  Vec3 expected;
  for (int k = 0; k < 60; ++k) {
    expected =
        onTool(fixed->step(again.to(Vec3(0.05, 0.05, 0.06 - 0.0004 * std::min(k, 40))), kStep));
  }
  EXPECT_LT((force - expected).norm(), 2e-3 * expected.norm());
  EXPECT_GT(expected.norm(), 0.1);
}

TEST_P(AdaptiveTissue, BalancesForcesInEveryCycle) {
  for (const char* method : {"implicit_pcg", "lbfgs", "tled"}) {
    AdaptiveSlab slab = slabFor(0.008);
    slab.settings.method = method;
    const auto tissue = slab.make();
    Press press;
    for (int k = 0; !press.done(); ++k) {
      const TissueStep& step = tissue->step({press.next()}, kStep);
      ASSERT_TRUE(solver::usable(step.status)) << method << " " << k;
      const Vec3 force = onTool(step);
      const Vec3 sum = step.support_force + step.gravity_force + step.inertia_force - force;
      EXPECT_LE(sum.norm(), 0.01 * force.norm() + 2e-3) << method << " " << k;
    }
  }
}

// Steps of BDF2 with damping in proportion to stiffness know the elastic forces of two steps
// before, on a mesh that is gone: the ball presses and lifts while a second one passes, whose mesh
// is made.
TEST_P(AdaptiveTissue, BalancesForcesOfTwoStepsBefore) {
  AdaptiveSlab slab = slabFor();
  slab.settings.integrator = "bdf2";
  slab.settings.stiffness_damping = 2e-3;
  const auto tissue = slab.make();
  Ball ball(Vec3(0.03, 0.05, 0.06)), other(Vec3(0.2, 0.05, 0.06));
  int changes = 0;
  std::uint64_t before = tissue->surfaceState(0).revision;
  for (int k = 0; k < 60; ++k) {
    const Vec3 at(0.03, 0.05, 0.048 + 0.004 * std::cos(0.3 * k));
    const Vec3 near(std::abs(0.2 - 0.0025 * k) + 0.075, 0.05, 0.06);
    const TissueStep& step = tissue->step({ball.to(at)[0], other.to(near)[0]}, kStep);
    const auto nodes = static_cast<double>(tissue->positions().cols());
    ASSERT_TRUE(step.ok()) << k;
    EXPECT_LE((step.support_force + step.inertia_force - onTool(step)).norm(),
              2.0 * std::sqrt(nodes) * std::max(step.residual, step.tolerance) + 1e-9)
        << k;
    const std::uint64_t now = tissue->surfaceState(0).revision;
    changes += now != before && !step.contacts.empty();
    before = now;
  }
  EXPECT_GT(changes, 2);
}

// A background task makes the viscous memory, too, with the threads of the cycles.
TEST_P(AdaptiveTissue, SameBitsWithThreadsAndAfterAReset) {
  ThreadPool pool(2);
  for (bool viscous : {false, true}) {
    AdaptiveSlab slab = slabFor(0.007);
    if (slab.mesh.quadratic() && !viscous) continue;  // slow
    if (viscous) slab.composition.solids[0].prony = {{0.4, 0.3}};
    const auto one = slab.make(), two = slab.make(&pool);
    const Points rest = one->positions();
    const auto run = [&](TissueModel* tissue) {
      Press press;
      while (!press.done()) tissue->step({press.next()}, kStep);
      return tissue->positions();
    };
    const Points first = run(one.get());
    EXPECT_EQ(run(two.get()), first);
    one->reset();
    EXPECT_EQ(one->positions(), rest);
    EXPECT_EQ(run(one.get()), first);
  }
}

// The only helper is busy, so that nobody makes it; then it is made, and taken.
TEST_P(AdaptiveTissue, DoesNotWaitForTheMeshAdaptationWhenItIsAskedToEnd) {
  ThreadPool pool(2);
  const auto tissue = slabFor(0.007).make(&pool);
  const Eigen::Index coarse = tissue->positions().cols();
  const solver::Interrupt at_once = [] { return true; };
  tissue->setInterrupt(&at_once);
  std::atomic<bool> open{false};
  ThreadPool::BackgroundTask busy(&pool);
  busy.begin([&] {
    while (!open) std::this_thread::yield();
  });
  Ball ball(Vec3(0.05, 0.05, 0.065));
  for (int k = 0; k < 12; ++k) {
    tissue->step(ball.to(Vec3(0.05, 0.05, 0.064)), kStep);
    EXPECT_EQ(tissue->positions().cols(), coarse);
  }
  open = true;
  busy.wait();
  for (int k = 0; k < 5000 && tissue->positions().cols() == coarse; ++k) {
    tissue->step(ball.to(Vec3(0.05, 0.05, 0.064)), kStep);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_GT(tissue->positions().cols(), coarse);
}

// Also when it was fine in a state that another process goes on from.
TEST_P(AdaptiveTissue, GoesBackToItsEquilibriumUnderGravity) {
  AdaptiveSlab slab = slabFor();
  slab.settings.gravity = Vec3(0.0, 0.0, -9.81);
  const auto first = slab.make(), other = slab.make();
  const Points equilibrium = first->positions();
  ASSERT_GT((equilibrium - first->cells(0).points).cwiseAbs().maxCoeff(), 1e-5);
  Ball ball(Vec3(0.05, 0.05, 0.052));
  for (int k = 0; k < 10; ++k) first->step(ball.to(Vec3(0.05, 0.05, 0.05)), kStep);
  ASSERT_GT(first->positions().cols(), equilibrium.cols());
  other->restore(first->state());
  for (int k = 0; k < 20; ++k) other->step(ball.to(Vec3(0.05, 0.05, 0.3)), kStep);
  ASSERT_EQ(other->positions().cols(), equilibrium.cols());
  other->reset();
  EXPECT_EQ(other->positions(), equilibrium);
}

// Refined and joined hundreds of times by a hand that does what it likes, and let go: nothing is
// left of it.
TEST_P(AdaptiveTissue, IsSteadyUnderRandomMotion) {
  const AdaptiveSlab slab = slabFor(0.007);
  const auto tissue = slab.make();
  const Points rest = tissue->positions();
  Vec3 at(0.05, 0.05, 0.052);
  Ball ball(at);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> pick(0.0, 1.0);
  Vec3 goal = at;
  double most_energy = 0.0;
  int failed = 0;
  const int cycles = slab.mesh.quadratic() ? 2000 : 3000;
  for (int k = 0; k < cycles; ++k) {
    if ((goal - at).norm() < 0.002) {
      goal = Vec3(0.015 + 0.07 * pick(random), 0.015 + 0.07 * pick(random),
                  0.045 + 0.03 * pick(random));
    }
    at += 0.001 * (goal - at).normalized();  // 0.1 m/s
    const TissueStep& step = tissue->step(ball.to(at), kStep);
    failed += !solver::usable(step.status);
    most_energy = std::max(most_energy, step.elastic_energy);
    ASSERT_TRUE(tissue->positions().allFinite());
  }
  EXPECT_EQ(failed, 0);
  // As often as its way, 1 mm a cycle, makes it worth a look; some ways end where it was fine.
  EXPECT_GT(static_cast<double>(tissue->surfaceState(0).revision),
            0.5 * cycles / (kMinToolMotion * slab.adapt.finest / 0.001 + kBackgroundTime / kStep));
  EXPECT_LT(most_energy, 0.01);  // 1 N over 10 mm
  TissueStep last;
  for (int k = 0; k < 300; ++k) last = tissue->step(ball.to(Vec3(0.05, 0.05, 0.3)), kStep);
  EXPECT_EQ(tissue->positions().cols(), rest.cols());
  EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT(last.kinetic_energy + last.elastic_energy, 1e-8);
}

TEST_P(AdaptiveTissue, KeepsWhatTouchesRemember) {
  AdaptiveSlab slab = slabFor();
  slab.settings.responses.push_back(test::kHold);
  slab.settings.contact.model = "hold";
  slab.settings.contact.stiffness = 1e7;
  const auto tissue = slab.make();
  Ball ball(Vec3(0.05, 0.05, 0.055)), other(Vec3(0.2, 0.05, 0.1));
  Vec3 force = Vec3::Zero(), before = Vec3::Zero();
  for (int k = 0; k < 80; ++k) {
    const double z = 0.055 - 0.0002 * std::min(k, 30) + 0.0001 * std::clamp(k - 30, 0, 40);
    if (k == 75) before = force;
    // A second ball comes near, so that the mesh changes while the first one pulls.
    const Vec3 near(k < 75 ? 0.2 : 0.1, 0.05, 0.06);
    force = onTool(tissue->step({ball.to(Vec3(0.05, 0.05, z))[0], other.to(near)[0]}, kStep));
  }
  EXPECT_LT(before.z(), -0.02);  // held, it pulls
  EXPECT_LT((force - before).norm(), 0.05 * before.norm());
}

// All that lies between held nodes.
TEST_P(AdaptiveTissue, HoldsWhatWasHeld) {
  AdaptiveSlab slab = slabFor();
  slab.adapt.growth = 0.05;  // fine down to the bottom
  const auto tissue = slab.make();
  Ball ball(Vec3(0.05, 0.05, 0.052));
  for (int k = 0; k < 20; ++k) {
    tissue->step(ball.to(Vec3(0.05, 0.05, 0.05 - 0.0003 * k)), kStep);
  }
  const Points rest = tissue->cells(0).points, x = tissue->positions();
  int held = 0;
  double moved = 0.0;
  for (Eigen::Index i = 0; i < rest.cols(); ++i) {
    moved = std::max(moved, (x.col(i) - rest.col(i)).norm());
    if (rest(2, i) != 0.0) continue;
    EXPECT_LT((x.col(i) - rest.col(i)).norm(), 1e-16);
    ++held;
  }
  EXPECT_GT(held, 1.2 * (slab.free.row(0).array() == 0.0).count());
  EXPECT_GT(moved, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Elements, AdaptiveTissue, ::testing::Values("anp", "tet10", "tet10p"),
                         [](const auto& element) { return std::string(element.param); });

}  // namespace
}  // namespace palpate::tissue::adaptive_tissue_test
