// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "palpate/fem/elasticity.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/integrator.h"
#include "palpate/solver/minimizer_list.h"
#include "palpate/solver/newton.h"
#include "palpate/solver/stale_pcg.h"

namespace palpate::solver::minimizers_test {
namespace {

constexpr double kStep = 0.01;

// A stiff floor that rises from below: contact on the nodes, with a set that changes.
class Floor final : public fem::EnergyTerm {
 public:
  double height = -1.0;                // [m]
  double stiffness = 2e3;              // [N/m]
  Vec3 normal = Vec3(-0.3, 0.0, 1.0);  // tilted: not all nodes at once

  double value(const Points& x) const override {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) sum += 0.5 * stiffness * depth(x, i) * depth(x, i);
    return sum;
  }
  double addGradient(const Points& x, Points* g) const override {
    for (Eigen::Index i = 0; i < x.cols(); ++i) g->col(i) -= stiffness * depth(x, i) * normal;
    return value(x);
  }
  void addHessian(const Points& x, fem::Tangent, fem::Stiffness* K) const override {
    for (int i = 0; i < K->numNodes(); ++i) {
      if (depth(x, i) <= 0.0) continue;
      K->add(i, i, stiffness * normal * normal.transpose());
    }
  }

 private:
  double depth(const Points& x, Eigen::Index i) const {
    return std::max(0.0, height - normal.dot(x.col(i)));
  }
};

// A block hung from its top, under which the floor rises.
struct Pushed {
  mutable ThreadPool team{2};
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(4));
  std::unique_ptr<fem::Elasticity> body;
  Floor floor;
  Integrator time{"backward_euler", body->masses(), {}};
  Potential potential{body.get(), {&floor}, fem::FreeMask::Ones(3, mesh.numPoints()), 1.0};
  Points x;
  NewtonSettings settings;
  NewtonReport last;
  int linear_iterations = 0;
  double rise = 0.003;  // of the floor in a step [m]

  explicit Pushed(double poisson_ratio = 0.45)
      : body(fem::makeElasticity(
            "anp", mesh,
            fem::Composition::uniform(material::makeMaterial(
                "stable_neo_hookean",
                {{"young_modulus", {6e3}}, {"poisson_ratio", {poisson_ratio}}})))) {
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) == 0.1) potential.free.col(i).setZero();
    }
    time.addTerms(&potential);
    settings.tolerance = 1e-7;
    settings.linear_tolerance = 1e-2;
  }
  void run(int steps, Minimizer* minimizer) {
    x = mesh.points;
    floor.height = -1.0;
    time.start(x, Points::Zero(3, x.cols()));
    linear_iterations = 0;
    for (int k = 0; k < steps; ++k) {
      minimizer->beginCycle(kStep);
      time.beginStep(kStep, &potential);
      if (k == 0) minimizer->prepare(potential, x);
      floor.height = -0.03 + rise * k;
      last = minimizer->minimize(potential, settings, &x);
      ASSERT_EQ(last.status, SolveStatus::kConverged) << "step " << k;
      ASSERT_LE(last.residual, settings.tolerance);
      linear_iterations += last.linear_iterations;
      time.endStep(x, Points());
    }
  }
  std::unique_ptr<Minimizer> make(const std::string& name, int threads = 1) const {
    return makeMinimizer(name, {2000, threads > 1 ? &team : nullptr}, body->makeMatrix());
  }
};

class EveryMinimizer : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Minimizers, EveryMinimizer, ::testing::ValuesIn(minimizerNames()),
                         [](const auto& name) { return name.param; });

TEST_P(EveryMinimizer, FindsTheMinimumThatNewtonFinds) {
  Pushed expected, pushed;
  expected.settings.tolerance = 1e-10;
  const auto newton = expected.make("implicit_direct"), minimizer = pushed.make(GetParam());
  expected.run(20, newton.get());
  pushed.run(20, minimizer.get());
  EXPECT_LT((expected.x - pushed.x).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_GT((expected.x - expected.mesh.points).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((newton->gradient() - minimizer->gradient()).norm(), 1e-5);
}

TEST_P(EveryMinimizer, IsAsNewAfterARestart) {
  Pushed first, second;
  const auto used = first.make(GetParam()), fresh = second.make(GetParam());
  first.run(12, used.get());
  used->restart();
  first.run(15, used.get());
  second.run(15, fresh.get());
  EXPECT_TRUE(first.x == second.x);
  EXPECT_EQ(first.linear_iterations, second.linear_iterations);
}

TEST_P(EveryMinimizer, GivesTheSameBitsWithOneThreadAndTwo) {
  Pushed first, second;
  const auto one = first.make(GetParam(), 1), two = second.make(GetParam(), 2);
  first.run(20, one.get());
  second.run(20, two.get());
  EXPECT_TRUE(first.x == second.x);
}

TEST_P(EveryMinimizer, PredictsWhereTheTangentLeads) {
  Pushed expected, pushed;
  Points move = Points::Zero(3, expected.mesh.numPoints());
  for (Eigen::Index i = 0; i < move.cols(); ++i) {
    if (expected.potential.free(0, i) == 0.0) move(0, i) = 0.005;
  }
  const auto guess = [&](Pushed* scene, const std::string& name) {
    const auto minimizer = scene->make(name);
    scene->x = scene->mesh.points;
    scene->time.start(scene->x, Points::Zero(3, scene->x.cols()));
    scene->time.beginStep(kStep, &scene->potential);
    EXPECT_EQ(minimizer->predict(scene->potential, move, &scene->x), SolveStatus::kConverged);
    return scene->x;
  };
  const Points right = guess(&expected, "implicit_direct");
  EXPECT_LT((guess(&pushed, GetParam()) - right).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_GT((right - expected.mesh.points).cwiseAbs().maxCoeff(), 0.004);
}

TEST_P(EveryMinimizer, SaysThatAStateIsNotFinite) {
  Pushed pushed;
  const auto minimizer = pushed.make(GetParam());
  pushed.run(2, minimizer.get());
  pushed.x(0, 0) = std::nan("");
  const Points before = pushed.x;
  EXPECT_EQ(minimizer->minimize(pushed.potential, pushed.settings, &pushed.x).status,
            SolveStatus::kNonFinite);
}

TEST_P(EveryMinimizer, EndsAfterAnIterationWhenAskedTo) {
  Pushed pushed;
  const Interrupt at_once = [] { return true; };
  pushed.settings.interrupt = &at_once;
  const auto minimizer = pushed.make(GetParam());
  pushed.x = pushed.mesh.points;
  pushed.time.start(pushed.x, Points::Zero(3, pushed.x.cols()));
  pushed.time.beginStep(kStep, &pushed.potential);
  pushed.floor.height = 0.01;
  const double before = pushed.potential.value(pushed.x);
  const NewtonReport report = minimizer->minimize(pushed.potential, pushed.settings, &pushed.x);
  EXPECT_EQ(report.status, SolveStatus::kDeadline);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_LE(report.linear_iterations, 8);
  EXPECT_LT(pushed.potential.value(pushed.x), before);
  const Interrupt never = [] { return false; };
  pushed.settings.interrupt = &never;
  EXPECT_EQ(minimizer->minimize(pushed.potential, pushed.settings, &pushed.x).status,
            SolveStatus::kConverged);
}

// Asks for the end at its n-th gradient, and counts those that come after.
class Watch final : public fem::EnergyTerm {
 public:
  int ends_at = 0;
  mutable int gradients = 0;

  double value(const Points&) const override { return 0.0; }
  double addGradient(const Points&, Points*) const override {
    ++gradients;
    return 0.0;
  }
  void addHessian(const Points&, fem::Tangent, fem::Stiffness*) const override {}
};

// No step from there is good enough.
class Trap final : public fem::EnergyTerm {
 public:
  explicit Trap(Points from) : from_(std::move(from)) {}
  mutable int gradients = 0;

  double value(const Points& x) const override { return x == from_ ? 0.0 : 1e9; }
  double addGradient(const Points& x, Points*) const override {
    ++gradients;
    return value(x);
  }
  void addHessian(const Points&, fem::Tangent, fem::Stiffness*) const override {}

 private:
  Points from_;
};

TEST_P(EveryMinimizer, GivesUpAFirstStepThatIsHalvedTooOftenWhenItIsAskedToEnd) {
  for (const bool late : {false, true}) {
    Pushed pushed;
    pushed.x = pushed.mesh.points;
    const Trap trap(pushed.x);
    pushed.potential.terms.push_back(&trap);
    pushed.time.start(pushed.x, Points::Zero(3, pushed.x.cols()));
    pushed.time.beginStep(kStep, &pushed.potential);
    pushed.floor.height = 0.01;
    const Interrupt asked = [late] { return late; };
    pushed.settings.interrupt = &asked;
    const NewtonReport report =
        pushed.make(GetParam())->minimize(pushed.potential, pushed.settings, &pushed.x);
    EXPECT_EQ(report.status, late ? SolveStatus::kDeadline : SolveStatus::kLineSearchFailed);
    EXPECT_EQ(report.iterations, 0);
    EXPECT_EQ(pushed.x, pushed.mesh.points);
    if (late) {
      EXPECT_LE(trap.gradients, 1 + NewtonSettings().least_halvings);
    } else {
      EXPECT_GT(trap.gradients, 20);
    }
  }
}

// From a shape that takes shortened steps to leave.
TEST_P(EveryMinimizer, LooksAtOnePointMoreWhenItIsAskedToEnd) {
  int seen = 0;
  for (int n = 1; n < 40; ++n) {
    Pushed pushed;
    Watch watch;
    watch.ends_at = n;
    pushed.potential.terms.push_back(&watch);
    pushed.time.start(pushed.mesh.points, Points::Zero(3, pushed.mesh.numPoints()));
    pushed.time.beginStep(1.0, &pushed.potential);
    pushed.x = pushed.mesh.points;
    for (Eigen::Index i = 0; i < pushed.x.cols(); ++i) {
      if (pushed.potential.free(0, i) != 0.0) pushed.x(0, i) += 0.2 * std::sin(37.0 * i);
    }
    const Interrupt asked = [&] { return watch.gradients >= watch.ends_at; };
    pushed.settings.interrupt = &asked;
    const NewtonReport report =
        pushed.make(GetParam())->minimize(pushed.potential, pushed.settings, &pushed.x);
    if (report.iterations < 2 || report.status != SolveStatus::kDeadline) continue;
    ++seen;
    EXPECT_LE(watch.gradients, n + 1) << n;
  }
  EXPECT_GT(seen, 5);
}

// At rest, a step begins over a floor of that height [m]: gradient and value there.
double beginOver(double height, Pushed* pushed, Points* g) {
  pushed->x = pushed->mesh.points;
  pushed->time.start(pushed->x, Points::Zero(3, pushed->x.cols()));
  pushed->time.beginStep(kStep, &pushed->potential);
  pushed->floor.height = height;
  return pushed->potential.gradient(pushed->x, g);
}

TEST(MinimizerLineSearch, EndsBetweenTrialsWhenAskedTo) {
  Pushed pushed;
  Points g;
  double value = beginOver(0.01, &pushed, &g);
  const Points far = -1e6 * g.cwiseProduct(pushed.potential.free);
  const Points before = pushed.x;
  const Interrupt at_once = [] { return true; };
  LineSearch search;
  EXPECT_FALSE(search.run(pushed.potential, far, &pushed.x, &g, &value, &at_once));
  EXPECT_EQ(pushed.x, before);
  EXPECT_TRUE(search.run(pushed.potential, far, &pushed.x, &g, &value));
  EXPECT_GT(search.halvings(), 0);
}

// However short the step, and small what it adds to the value.
TEST(MinimizerLineSearch, TakesNoStepUphill) {
  Pushed pushed;
  Points g;
  double value = beginOver(0.01, &pushed, &g);
  const Points before = pushed.x;
  for (const double length : {1e-3, 1e-6, 1e-8}) {
    const Points uphill = length / g.norm() * g.cwiseProduct(pushed.potential.free);
    LineSearch search;
    EXPECT_FALSE(search.run(pushed.potential, uphill, &pushed.x, &g, &value)) << length;
    EXPECT_EQ(pushed.x, before) << length;
  }
}

// With linear solves to 0.5 alone it would take 33 iterations to 1e-10 of the first residual.
TEST(Newton, SolvesLinearSystemsBetterWhereItsStepsAreGood) {
  Pushed pushed;
  pushed.settings.linear_tolerance = 0.5;
  const auto newton = pushed.make("implicit_pcg");
  Points g;
  beginOver(0.005, &pushed, &g);
  pushed.settings.tolerance = 1e-10 * freeNorm(g, pushed.potential.free);
  const NewtonReport report = newton->minimize(pushed.potential, pushed.settings, &pushed.x);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_LT(report.iterations, 15);
}

TEST(MinimizerList, RefusesAnUnknownName) {
  const Pushed pushed;
  EXPECT_THROW(pushed.make("gradient_descent"), std::invalid_argument);
}

// The factor of a step a thousand times shorter is nearly diagonal: of no use for this one.
TEST(Lbfgs, ConvergesWithAFactorThatIsOfNoUse) {
  Pushed pushed;
  const auto lbfgs = pushed.make("lbfgs");
  pushed.x = pushed.mesh.points;
  pushed.time.start(pushed.x, Points::Zero(3, pushed.x.cols()));
  pushed.time.beginStep(1e-3 * kStep, &pushed.potential);
  lbfgs->prepare(pushed.potential, pushed.x);
  pushed.time.beginStep(kStep, &pushed.potential);
  pushed.floor.height = 0.01;
  const NewtonReport report = lbfgs->minimize(pushed.potential, pushed.settings, &pushed.x);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_LT(report.iterations, 100);
}

TEST(Lbfgs, StopsAtItsLimitWithABetterState) {
  Pushed pushed;
  pushed.settings.max_iterations = 1;  // ten of its own
  pushed.settings.tolerance = 1e-14;
  const auto lbfgs = pushed.make("lbfgs");
  pushed.x = pushed.mesh.points;
  pushed.time.start(pushed.x, Points::Zero(3, pushed.x.cols()));
  pushed.time.beginStep(kStep, &pushed.potential);
  pushed.floor.height = 0.01;
  const double before = pushed.potential.value(pushed.x);
  const NewtonReport report = lbfgs->minimize(pushed.potential, pushed.settings, &pushed.x);
  EXPECT_EQ(report.status, SolveStatus::kIterationLimit);
  EXPECT_EQ(report.iterations, 10);
  EXPECT_LT(pushed.potential.value(pushed.x), before);
}

TEST(MinimizerStalePcg, NeedsFarFewerIterationsThanBlockJacobi) {
  Pushed plain(0.499), stale(0.499);
  const auto pcg = plain.make("implicit_pcg"), async = stale.make("implicit_async");
  plain.rise = stale.rise = 0.002;
  plain.settings.tolerance = stale.settings.tolerance = 1e-4;
  plain.run(15, pcg.get());
  stale.run(15, async.get());
  EXPECT_LT(3 * stale.linear_iterations, plain.linear_iterations);
}

// A solve of its own: what prepare() has not factorised is begun by a solve and taken into use some
// cycles later, never before.
TEST(MinimizerStalePcg, TakesAFactorIntoUseAtAFixedCycle) {
  Pushed pushed;
  pushed.time.start(pushed.mesh.points, Points::Zero(3, pushed.mesh.numPoints()));
  pushed.time.beginStep(kStep, &pushed.potential);
  fem::Stiffness A = pushed.body->makeMatrix();
  pushed.potential.hessian(pushed.mesh.points, fem::Tangent::kExact, &A);
  A.constrain(pushed.potential.free);
  const Points b = Points::Random(3, pushed.mesh.numPoints()).cwiseProduct(pushed.potential.free);
  for (const bool own_thread : {false, true}) {
    StalePcg pcg(A, 2000, own_thread);
    std::vector<int> iterations;
    for (int k = 0; k < 4; ++k) {
      pcg.beginCycle(kStep);
      Points x, Ax;
      const LinearReport report = pcg.solve(A, b, 1e-10, &x);
      ASSERT_EQ(report.status, SolveStatus::kConverged);
      A.multiply(x, &Ax);
      EXPECT_LE((b - Ax).norm(), 1e-9 * b.norm());
      iterations.push_back(report.iterations);
    }
    EXPECT_GT(iterations[0], 20);
    EXPECT_EQ(iterations[1], iterations[0]);  // begun in cycle 0, used from cycle 2 on
    EXPECT_LE(iterations[2], 3);
    EXPECT_LE(iterations[3], 3);
  }
}

}  // namespace
}  // namespace palpate::solver::minimizers_test
