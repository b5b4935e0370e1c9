// SPDX-License-Identifier: GPL-3.0-or-later
// Several bodies as one: energies, forces and matrices are the bodies' own, one after another.
#include "palpate/solver/joint_potential.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "palpate/fem/elasticity.h"
#include "palpate/fem/loads.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/inertia.h"
#include "support/random.h"

namespace palpate::solver::joint_potential_test {
namespace {

// A block of an element, drawn down and not at rest, with a held bottom and masses.
struct Body {
  Body(const std::string& element, const Vec3& at, double scale, test::Random* random) {
    mesh = fem::meshFor(element, mesh::boxMesh(Vec3(0.04, 0.05, 0.03), Eigen::Vector3i(2, 3, 2)));
    mesh.points.colwise() += at;
    elasticity = fem::makeElasticity(
        element, mesh,
        fem::Composition::uniform(
            material::makeMaterial("stable_neo_hookean",
                                   {{"young_modulus", {6.0e3}}, {"poisson_ratio", {0.45}}}),
            1060.0));
    load = std::make_unique<fem::DeadLoad>(random->points(mesh.numPoints(), 1e-3));
    inertia.beginStep(mesh.points, 1e4, elasticity->masses());
    potential = {
        elasticity.get(), {load.get(), &inertia}, fem::FreeMask::Ones(3, mesh.numPoints()), scale};
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) <= at.z()) potential.free.col(i).setZero();
    }
    x = mesh.points + random->points(mesh.numPoints(), 3e-4);
  }

  mesh::TetMesh mesh;
  std::unique_ptr<fem::Elasticity> elasticity;
  std::unique_ptr<fem::DeadLoad> load;
  Inertia inertia;
  Potential potential;
  Points x;
};

// Springs between the first nodes of one body and the last ones of another, to be found by a
// gradient in all of them.
class Springs final : public fem::EnergyTerm {
 public:
  Springs(int first, int second) : first_(first), second_(second) {}
  double value(const Points& x) const override {
    double sum = 0.0;
    for (int k = 0; k < kCount; ++k) sum += 0.5 * kStiffness * way(x, k).squaredNorm();
    return sum;
  }
  double addGradient(const Points& x, Points* g) const override {
    for (int k = 0; k < kCount; ++k) {
      g->col(k) -= kStiffness * way(x, k);
      g->col(other(k)) += kStiffness * way(x, k);
    }
    return value(x);
  }
  void addHessian(const Points&, fem::Tangent, fem::Stiffness* K) const override {
    const Mat3 H = kStiffness * Mat3::Identity();
    for (int k = 0; k < kCount; ++k) {
      K->add(k, k, H);
      K->add(other(k), other(k), H);
      K->add(k, other(k), -H);
      K->add(other(k), k, -H);
    }
  }

 private:
  static constexpr int kCount = 5;
  static constexpr double kStiffness = 30.0;  // [N/m]
  int other(int k) const { return first_ + second_ - 1 - k; }
  Vec3 way(const Points& x, int k) const { return x.col(other(k)) - x.col(k); }
  int first_, second_;
};

class SideBySide : public ::testing::TestWithParam<std::pair<const char*, const char*>> {
 protected:
  test::Random random;
  Body a{GetParam().first, Vec3::Zero(), 1.0, &random};
  Body b{GetParam().second, Vec3(0.1, 0.0, 0.02), 1.3, &random};
  JointPotential joint{{&a.potential, &b.potential}};
  std::vector<double> scales;
  const Eigen::Index n = a.x.cols(), m = b.x.cols();
  Points x = Points(3, n + m);

  void SetUp() override {
    x << a.x, b.x;
    EXPECT_TRUE(joint.takeScales(&scales));
    EXPECT_FALSE(joint.takeScales(&scales));
  }
};
INSTANTIATE_TEST_SUITE_P(
    Elements, SideBySide,
    ::testing::Values(std::make_pair("anp", "anp"), std::make_pair("tet4", "anp"),
                      std::make_pair("tet10p", "tet10"), std::make_pair("p1p1", "anp")),
    [](const auto& pair) { return std::string(pair.param.first) + "_" + pair.param.second; });

TEST_P(SideBySide, EnergyAndForcesAreThoseOfTheBodies) {
  Points g, g_a, g_b;
  const double value = joint.all().gradient(x, &g);
  const double expected = a.potential.gradient(a.x, &g_a) + b.potential.gradient(b.x, &g_b);
  EXPECT_NEAR(value, expected, 1e-14 * std::abs(expected));
  EXPECT_NEAR(joint.all().value(x), expected, 1e-14 * std::abs(expected));
  EXPECT_LE((g.leftCols(n) - g_a).norm(), 1e-14 * g_a.norm());
  EXPECT_LE((g.rightCols(m) - g_b).norm(), 1e-14 * g_b.norm());
}

// With a metric that is not diagonal, its solve rounds.
TEST_P(SideBySide, TheMatrixActsOnEachAsItsOwn) {
  fem::Stiffness K = joint.makeMatrix(), K_a = a.elasticity->makeMatrix(),
                 K_b = b.elasticity->makeMatrix();
  joint.all().hessian(x, fem::Tangent::kExact, &K);
  a.potential.hessian(a.x, fem::Tangent::kExact, &K_a);
  b.potential.hessian(b.x, fem::Tangent::kExact, &K_b);
  EXPECT_TRUE(K.couplings().empty());
  const Points d = random.points(n + m, 1.0);
  Points y, y_a, y_b;
  K.multiply(d, &y);
  K_a.multiply(d.leftCols(n), &y_a);
  K_b.multiply(d.rightCols(m), &y_b);
  EXPECT_LE((y.leftCols(n) - y_a).norm(), 1e-12 * y_a.norm());
  EXPECT_LE((y.rightCols(m) - y_b).norm(), 1e-12 * y_b.norm());
}

TEST_P(SideBySide, WhatActsBetweenThemIsFoundInMatrixAndSolve) {
  const Springs springs(static_cast<int>(n), static_cast<int>(m));
  const std::vector<const fem::EnergyTerm*> terms = {&springs};
  const MappedTerms between(terms, joint.nodeMapOf(0, 1), static_cast<int>(n + m));
  joint.setFurther({&between});
  fem::Stiffness K = joint.makeMatrix();
  joint.all().hessian(x, fem::Tangent::kExact, &K);
  EXPECT_FALSE(K.couplings().empty());
  const Points d = random.points(n + m, 1.0);
  constexpr double h = 1e-7;
  Points Kd, forward, back;
  K.multiply(d, &Kd);
  joint.all().gradient(x + h * d, &forward);
  joint.all().gradient(x - h * d, &back);
  EXPECT_LE(((forward - back) / (2.0 * h) - Kd).norm(), 1e-6 * Kd.norm());

  K.constrain(joint.all().free);
  const Points right = random.points(n + m, 1.0).cwiseProduct(joint.all().free);
  Points solution, product;
  BlockPcg pcg(2000);
  ASSERT_EQ(pcg.solve(K, right, 1e-9, &solution).status, SolveStatus::kConverged);
  K.multiply(solution, &product);
  EXPECT_LE((product - right).norm(), 1e-8 * right.norm());
}

// In the orders of the bodies' own solvers, one of which has a coarse space.
TEST_P(SideBySide, IsSolvedInTheBodiesOwnOrders) {
  const Springs springs(static_cast<int>(n), static_cast<int>(m));
  const std::vector<const fem::EnergyTerm*> terms = {&springs};
  const MappedTerms between(terms, joint.nodeMapOf(0, 1), static_cast<int>(n + m));
  joint.setFurther({&between});
  BlockPcg of_a(2000, nullptr, bestIsa(), a.mesh.points), of_b(2000);
  fem::Stiffness K_a = a.elasticity->makeMatrix(), K = joint.makeMatrix();
  a.potential.hessian(a.mesh.points, fem::Tangent::kExact, &K_a);
  K_a.constrain(a.potential.free);
  of_a.takePattern(K_a);
  of_a.learnFromRest(K_a);
  of_b.takePattern(b.elasticity->makeMatrix());
  joint.all().hessian(x, fem::Tangent::kExact, &K);
  K.constrain(joint.all().free);
  const Points right = random.points(n + m, 1.0).cwiseProduct(joint.all().free);
  ThreadPool pool(2);
  Points solution, product, again;
  BlockPcg one(2000, nullptr, {&of_a, &of_b}), two(2000, &pool, {&of_a, &of_b});
  ASSERT_EQ(one.solve(K, right, 1e-9, &solution).status, SolveStatus::kConverged);
  K.multiply(solution, &product);
  EXPECT_LE((product - right).norm(), 1e-8 * right.norm());
  two.solve(K, right, 1e-9, &again);
  EXPECT_EQ(solution, again);
}

// Long bars, whose ends hear of each other by their coarse spaces.
TEST(JointPcg, NeedsAsManyIterationsAsTheBodiesAlone) {
  test::Random random;
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.4, 0.03, 0.03), Eigen::Vector3i(60, 4, 4));
  const auto elasticity = fem::makeElasticity(
      "anp", mesh,
      fem::Composition::uniform(
          material::makeMaterial("stable_neo_hookean",
                                 {{"young_modulus", {6.0e3}}, {"poisson_ratio", {0.45}}}),
          1060.0));
  Inertia inertia;
  inertia.beginStep(mesh.points, 1e4, elasticity->masses());
  const Potential bar{elasticity.get(), {&inertia}, fem::FreeMask::Ones(3, mesh.numPoints())};
  JointPotential both({&bar, &bar});
  std::vector<double> scales;
  both.takeScales(&scales);
  const Eigen::Index n = mesh.numPoints();
  Points x(3, 2 * n), solution;
  x << mesh.points, mesh.points;
  fem::Stiffness K_bar = elasticity->makeMatrix(), K = both.makeMatrix();
  bar.hessian(mesh.points, fem::Tangent::kExact, &K_bar);
  both.all().hessian(x, fem::Tangent::kExact, &K);
  const Points right = random.points(2 * n, 1.0);
  BlockPcg first(2000, nullptr, bestIsa(), mesh.points),
      second(2000, nullptr, bestIsa(), mesh.points);
  for (BlockPcg* solver : {&first, &second}) {
    solver->takePattern(K_bar);
    solver->learnFromRest(K_bar);
  }
  BlockPcg joint(2000, nullptr, {&first, &second}), plain(2000);
  const int together = joint.solve(K, right, 1e-3, &solution).iterations;
  const int without = plain.solve(K, right, 1e-3, &solution).iterations;
  const int alone = std::max(first.solve(K_bar, right.leftCols(n), 1e-3, &solution).iterations,
                             second.solve(K_bar, right.rightCols(n), 1e-3, &solution).iterations);
  std::printf("%d iterations together, %d alone, %d without coarse spaces\n", together, alone,
              without);
  // The spectrum of both is that of one.
  EXPECT_LE(together, alone + 2);
  EXPECT_LT(together, without);
}

// The nodes of a pair lie where the two are in the group, in whatever order.
TEST_P(SideBySide, APairIsPlacedByItsMembers) {
  const fem::Stiffness::NodeMap forward = joint.nodeMapOf(0, 1), back = joint.nodeMapOf(1, 0),
                                alone = joint.nodeMapOf(1, 1);
  EXPECT_EQ(forward.of(0), 0);
  EXPECT_EQ(forward.of(static_cast<int>(n)), n);
  EXPECT_EQ(back.of(0), n);
  EXPECT_EQ(back.of(static_cast<int>(m)), 0);
  EXPECT_EQ(alone.of(static_cast<int>(m) - 1), n + m - 1);
}

}  // namespace
}  // namespace palpate::solver::joint_potential_test
