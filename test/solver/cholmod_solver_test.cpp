// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/cholmod_solver.h"

#include <gtest/gtest.h>

#include "palpate/fem/elasticity.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/potential.h"
#include "support/random.h"

namespace palpate::solver::cholmod_solver_test {
namespace {

constexpr double kTolerance = 1e-2;  // as Newton's method asks, far from the end
constexpr double kLoosest = 1e-3;    // what it gets
constexpr double kRounding = 1e-9;

struct System {
  fem::Stiffness A;
  Points b;

  double residual(const Points& x) const {
    Points Ax;
    A.multiply(x, &Ax);
    return (b - Ax).norm() / b.norm();
  }
};

// A cube of 6 x 6 x 6 cells, held at its bottom and bent by `bend` [m]; contacts of `stiffness`
// [N/m] press `touching` nodes of its top.
System cube(double bend, int touching, double stiffness) {
  constexpr int kCells = 6;
  test::Random random;
  const mesh::TetMesh mesh =
      fem::meshFor("tet4", mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(kCells)));
  const fem::Composition solids{
      {material::Solid{material::makeMaterial("stable_neo_hookean", {{"young_modulus", {5e3}},
                                                                     {"poisson_ratio", {0.45}}}),
                       1000.0,
                       {}}},
      {},
      {}};
  const auto body = fem::makeElasticity("tet4", mesh, solids);
  System system;
  system.A = body->makeMatrix();
  Points x = mesh.points;
  x.row(0) += bend * mesh.points.row(2).array().square().matrix() / 0.1;
  body->hessian(x, fem::Tangent::kExact, &system.A);
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    if (mesh.points(2, i) == 0.0) free.col(i).setZero();
    if (mesh.points(2, i) < 0.1 || touching-- <= 0) continue;
    const Vec3 normal = (Vec3::UnitZ() + 0.1 * random.points(1, 1.0).col(0)).normalized();
    system.A.add(static_cast<int>(i), static_cast<int>(i), stiffness * normal * normal.transpose());
  }
  system.A.constrain(free);
  system.b = random.points(mesh.numPoints(), 1.0).cwiseProduct(free);
  return system;
}

// Iterations.
int solve(CholmodSolver* solver, const System& system, double tolerance = kTolerance) {
  Points x;
  const LinearReport report = solver->solve(system.A, system.b, tolerance, &x);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_LT(system.residual(x), report.iterations > 0 ? std::min(tolerance, kLoosest) : kRounding);
  return report.iterations;
}

TEST(CholmodSolver, SolvesByTheFirstFactorOfACycle) {
  CholmodSolver solver;
  solver.beginCycle(0.01);
  EXPECT_EQ(solve(&solver, cube(0.0, 10, 1e3)), 0);
  for (int touching = 8; touching < 15; touching += 2) {
    EXPECT_GT(solve(&solver, cube(0.01, touching, 3e3)), 0) << touching;
  }
  EXPECT_GT(solve(&solver, cube(0.01, 10, 3e3), 1e-6), 0);
}

TEST(CholmodSolver, HasTheBitsOfANewOneInEachCycle) {
  CholmodSolver old, fresh;
  old.beginCycle(0.01);
  solve(&old, cube(0.0, 3, 1e3));
  solve(&old, cube(0.002, 7, 1e3));
  old.beginCycle(0.01);
  const System system = cube(0.002, 9, 1e3);
  Points x, y;
  EXPECT_EQ(old.solve(system.A, system.b, kTolerance, &x).iterations, 0);
  fresh.solve(system.A, system.b, kTolerance, &y);
  EXPECT_EQ(x, y);
}

// A factor of no use costs no more than another, and fewer and fewer matrices are tried with it.
TEST(CholmodSolver, FactorisesWhereIterationsCostAsMuch) {
  CholmodSolver solver;
  solver.beginCycle(0.01);
  solve(&solver, cube(0.0, 0, 0.0));
  int tried = 0;
  for (int k = 0; k < 15; ++k) {
    const System system = cube(0.05, k % 2 == 0 ? 49 : 0, 1e6);
    Points x;
    const LinearReport report = solver.solve(system.A, system.b, kTolerance, &x);
    EXPECT_EQ(report.status, SolveStatus::kConverged);
    EXPECT_LT(system.residual(x), kRounding) << k;
    tried += report.iterations > 0;
  }
  EXPECT_GT(tried, 0);
  EXPECT_LE(tried, 5);
}

TEST(CholmodSolver, TellsThatAMatrixIsNotPositiveDefinite) {
  CholmodSolver solver;
  solver.beginCycle(0.01);
  solve(&solver, cube(0.0, 0, 0.0));
  System system = cube(0.0, 0, 0.0);
  const int last = system.A.numNodes() - 1;
  system.A.add(last, last, -1e3 * Mat3::Identity());
  Points x;
  EXPECT_EQ(solver.solve(system.A, system.b, kTolerance, &x).status,
            SolveStatus::kNotPositiveDefinite);
  EXPECT_EQ(solve(&solver, cube(0.0, 1, 1e3)), 0);  // there is no factor any more
  EXPECT_EQ(solve(&solver, cube(0.0, 2, 1e3)), 0);  // factorised at once
  EXPECT_GT(solve(&solver, cube(0.0, 3, 1e3)), 0);
}

}  // namespace
}  // namespace palpate::solver::cholmod_solver_test
