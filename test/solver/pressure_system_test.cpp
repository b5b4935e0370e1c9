// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/pressure_system.h"

#include <gtest/gtest.h>

#include "palpate/fem/elasticity.h"
#include "palpate/fem/supports.h"
#include "palpate/solver/cholmod_solver.h"
#include "support/random.h"

namespace palpate::solver::pressure_system_test {
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
TEST(CholmodPressure, FindsTheSameBothWays) {
  for (const double poisson_ratio : {0.45, 0.4995}) {
    const Cube cube("anp", poisson_ratio, 6);
    Points x;
    CholmodSolver solver;
    EXPECT_EQ(solver.solve(cube.K, cube.b, 1e-10, &x).status, SolveStatus::kConverged);
    EXPECT_LE(cube.residual(x), 1.01e-10);
  }
}

// Nine tenths of the stiffness of all volumes are taken from the elements: what is left of them is
// indefinite, the whole is not.
TEST(CholmodPressure, FactorisesAllWhereTheRestIsNotDefinite) {
  Cube cube("anp", 0.45, 3);
  const fem::VolumeStiffness& volume = cube.K.volume();
  const fem::VolumeStiffness::Pattern& pattern = *volume.pattern;
  for (Eigen::Index p = 0; p < volume.numRows(); ++p) {
    const double taken = 0.9 * volume.factor * volume.metric->weights()[p];
    for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
      for (int l = pattern.start[p]; l < pattern.start[p + 1]; ++l) {
        cube.K.add(pattern.node[k], pattern.node[l],
                   -taken * volume.rows.col(k) * volume.rows.col(l).transpose());
      }
    }
  }
  PressureSystem system;
  system.prepare(cube.K);
  EXPECT_EQ(system.factorize(cube.K), SolveStatus::kNotPositiveDefinite);
  Points x;
  CholmodSolver solver;
  EXPECT_EQ(solver.solve(cube.K, cube.b, 1e-10, &x).status, SolveStatus::kConverged);
  EXPECT_LE(cube.residual(x), 1e-9);
}

}  // namespace
}  // namespace palpate::solver::pressure_system_test
