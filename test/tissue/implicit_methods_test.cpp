// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/solver/integrator.h"
#include "palpate/solver/minimizer_list.h"
#include "slab.h"

namespace palpate::tissue::implicit_methods_test {
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

// Rounding in the velocities of held nodes must not move them: extrapolated, it would grow.
TEST_P(EveryImplicitMethod, HeldNodesStayInTheirPlacesToTheLastBit) {
  for (const std::string& integrator : solver::integratorNames()) {
    Slab slab = slabFor(GetParam());
    slab.mesh.points *= 1.01;  // off round numbers
    slab.mesh.points.row(2).array() += 0.013;
    slab.settings.integrator = integrator;
    const auto tissue = slab.make();
    Press press;
    for (int k = 0; k < 120; ++k) {
      // So fast a tool turns elements inside out.
      ASSERT_TRUE(solver::balanced(tissue->step({press.next()}, 0.0005).status)) << integrator;
      const Points moved =
          (tissue->positions() - slab.mesh.points).array() * (1.0 - slab.free.array());
      ASSERT_EQ(moved.cwiseAbs().maxCoeff(), 0.0) << integrator << ", step " << k;
    }
  }
}

// Always late: one iteration a solve, and the body still gives way to the tool.
TEST_P(EveryImplicitMethod, GoesOnWithTheBestStateAtADeadline) {
  const solver::Interrupt at_once = [] { return true; };
  const Slab slab = slabFor(GetParam());
  const auto tissue = slab.make(), reference = slab.make();
  tissue->setInterrupt(&at_once);
  double peak = 0.0, expected = 0.0;
  int late = 0;
  for (Press a, b; !a.done();) {
    expected = std::max(expected, onTool(reference->step({a.next()}, kStep)).norm());
    const TissueStep& step = tissue->step({b.next()}, kStep);
    ASSERT_TRUE(solver::usable(step.status)) << solver::toString(step.status);
    EXPECT_EQ(step.time_steps, 1);
    EXPECT_GT(step.min_jacobian, 0.0);
    late += step.status == solver::SolveStatus::kDeadline ? 1 : 0;
    EXPECT_TRUE(step.ok() || step.residual > step.tolerance);
    peak = std::max(peak, onTool(step).norm());
  }
  EXPECT_GT(late, 10);
  // Of the right size, no more: one iteration cannot follow a contact that begins.
  EXPECT_GT(peak, 0.5 * expected);
  EXPECT_LT(peak, 3.0 * expected);
  tissue->setInterrupt(nullptr);
  EXPECT_TRUE(tissue->step({}, kStep).ok());
}

// How far from an exactly solved one a body is, while it sways and nothing but position_tolerance
// says when a solve is good enough.
double worstError(double h, double tolerance) {
  Slab slab(Eigen::Vector3i(3, 3, 2));
  slab.settings.gravity.setZero();
  slab.settings.tolerance = 1e-12;
  slab.settings.position_tolerance = tolerance;
  Slab exact = slab;
  exact.settings.position_tolerance = 1e-12;
  exact.settings.linear_tolerance = 1e-3;
  const auto tissue = slab.make(), reference = exact.make();
  Points v = Points::Zero(3, slab.mesh.numPoints());
  v.row(0) = 5.0 * slab.mesh.points.row(2);  // shear, 0.2 m/s at the top
  tissue->setPositions(0, slab.mesh.points, v);
  reference->setPositions(0, slab.mesh.points, v);
  double worst = 0.0;
  for (double t = 0.0; t < 0.2 - 1e-9; t += h) {
    EXPECT_TRUE(tissue->step({}, h).ok());
    EXPECT_TRUE(reference->step({}, h).ok());
    worst =
        std::max(worst, (tissue->positions() - reference->positions()).colwise().norm().maxCoeff());
  }
  return worst;
}

TEST(PositionTolerance, BoundsTheErrorOfPositionsWhateverTheStep) {
  constexpr double kTolerance = 1e-4;
  for (const double h : {0.02, 0.01, 0.005, 0.0025, 0.00125}) {
    const double error = worstError(h, kTolerance);
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, kTolerance) << "h = " << h;
  }
  EXPECT_LT(worstError(0.005, 0.01 * kTolerance), 0.01 * kTolerance);
}

// Of 40 cycles of a press those that are not solved, of quadratic elements next to the
// incompressible, the upper ones 30,000 times as stiff.
int unsolvedCycles(const std::string& method) {
  Slab slab;
  slab.settings.element = "tet10";
  slab.settings.method = method;
  slab.settings.gravity.setZero();
  slab.mesh = fem::meshFor("tet10", mesh::boxMesh(Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(3, 3, 2)));
  slab.holdBottom();
  fem::Composition solids;
  for (const double young_modulus : {300.0, 1e7}) {
    solids.solids.push_back(
        {material::makeMaterial("stable_neo_hookean",
                                {{"young_modulus", {young_modulus}}, {"poisson_ratio", {0.4999}}}),
         1060.0,
         {}});
  }
  for (Eigen::Index t = 0; t < slab.mesh.tets.cols(); ++t) {
    solids.solid_of.push_back(slab.mesh.points(2, slab.mesh.tets(0, t)) < 0.02 ? 0 : 1);
  }
  const auto tissue = makeFemTissue(slab.mesh, solids, slab.free, slab.settings, nullptr);
  int unsolved = 0;
  Press press;
  for (int k = 0; k < 40; ++k) unsolved += !tissue->step({press.next()}, kStep).ok();
  return unsolved;
}

// Where iterations end at their limit: of 40 cycles they alone leave 27 unsolved.
TEST(ImplicitPcg, SolvesWhatAFactorDoes) {
  EXPECT_LE(unsolvedCycles("implicit_pcg"), unsolvedCycles("implicit_direct") + 2);
}

}  // namespace
}  // namespace palpate::tissue::implicit_methods_test
