// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/pressure_system.h"

#include <gtest/gtest.h>

#include "palpate/fem/elasticity.h"
#include "palpate/fem/supports.h"
#include "palpate/solver/cholmod_solver.h"
#include "support/random.h"

namespace palpate::solver {
namespace {

// A cube that is held below, a little bent.
struct Cube {
  Cube(const std::string& element, double poisson_ratio, int cells) {
    const auto law = material::makeMaterial(
        "neo_hookean", {{"young_modulus", {5e3}}, {"poisson_ratio", {poisson_ratio}}});
    const auto mesh =
        fem::meshFor(element, mesh::boxMesh(Vec3::Constant(0.1), Eigen::Vector3i::Constant(cells)));
    const auto body = fem::makeElasticity(element, mesh, fem::Composition::uniform(law));
    test::Random random;
    const fem::FreeMask free =
        (mesh.points.row(2).replicate(3, 1).array() > 1e-9).cast<double>().matrix();
    K = body->makeMatrix();
    body->hessian(mesh.points + random.points(mesh.numPoints(), 1e-6), fem::Tangent::kExact, &K);
    K.constrain(free);
    b = random.points(mesh.numPoints(), 1.0).cwiseProduct(free);
  }
  double residual(const Points& x) const {
    Points Kx;
    K.multiply(x, &Kx);
    return (b - Kx).norm() / b.norm();
  }
  fem::Stiffness K;
  Points b;
};

class Pressures : public ::testing::TestWithParam<std::tuple<std::string, double>> {};

TEST_P(Pressures, AreSolvedForToTheTolerance) {
  const auto [element, poisson_ratio] = GetParam();
  const Cube cube(element, poisson_ratio, element == "tet10p" ? 3 : 6);
  PressureSystem system;
  const double expected = system.prepare(cube.K);
  ASSERT_EQ(system.factorize(cube.K), SolveStatus::kConverged);
  int last = 0;
  for (const double tolerance : {1e-3, 1e-6, 1e-10}) {
    Points x;
    const LinearReport report = system.solve(cube.K, cube.b, tolerance, &x);
    EXPECT_EQ(report.status, SolveStatus::kConverged);
    EXPECT_LE(cube.residual(x), 1.01 * tolerance);
    EXPECT_GT(report.iterations, last);
    last = report.iterations;
  }
  EXPECT_LT(last, 12.0 * expected);
}

INSTANTIATE_TEST_SUITE_P(All, Pressures,
                         ::testing::Combine(::testing::Values("anp", "tet10p", "p1p1"),
                                            ::testing::Values(0.3, 0.45, 0.499)));

// Whichever way is taken, by iterations or by the factor of all, the answer is the same.
TEST(CholmodSolver, FindsTheSameBothWays) {
  for (const double poisson_ratio : {0.45, 0.4995}) {
    const Cube cube("anp", poisson_ratio, 6);
    Points x;
    CholmodSolver solver;
    EXPECT_EQ(solver.solve(cube.K, cube.b, 1e-10, &x).status, SolveStatus::kConverged);
    EXPECT_LE(cube.residual(x), 1.01e-10);
  }
}

// Compressed so far that the elements alone would buckle, while volumes hold them.
TEST(CholmodSolver, FactorisesAllWhereTheRestIsNotDefinite) {
  Cube cube("anp", 0.45, 3);
  PressureSystem system;
  Points x;
  for (int i = 0; i < cube.K.numNodes(); ++i) {
    auto block = cube.K.blocks().block(cube.K.blocks().diagonal(i));
    if (cube.b.col(i).isZero()) continue;
    block.diagonal().array() -= 0.12 * block.trace() / 3.0;
  }
  CholmodSolver solver;
  const LinearReport report = solver.solve(cube.K, cube.b, 1e-10, &x);
  system.prepare(cube.K);
  EXPECT_EQ(system.factorize(cube.K), SolveStatus::kNotPositiveDefinite);
  if (report.status == SolveStatus::kConverged) {
    EXPECT_LE(cube.residual(x), 1e-8);
  } else {
    EXPECT_EQ(report.status, SolveStatus::kNotPositiveDefinite);
  }
}

}  // namespace
}  // namespace palpate::solver
