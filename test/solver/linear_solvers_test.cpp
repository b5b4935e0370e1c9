// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/potential.h"
#include "support/random.h"

namespace palpate::solver {
namespace {

// Stiffness of a held box: what the solvers meet.
struct System {
  fem::BlockMatrix A;
  Points b;
  Eigen::MatrixXd dense;

  System() {
    test::Random random;
    const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(3));
    const auto body = fem::makeElasticity(
        "tet4", mesh,
        material::makeMaterial("stable_neo_hookean",
                               {{"young_modulus", {5e3}}, {"poisson_ratio", {0.45}}}));
    A = body->makeMatrix();
    body->hessian(mesh.points, fem::Tangent::kExact, &A);
    fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
    free.leftCols(16).setZero();
    free(1, 20) = 0.0;
    A.constrain(free);
    b = random.points(mesh.numPoints(), 1.0).cwiseProduct(free);
    dense.setZero(b.size(), b.size());
    for (int i = 0; i < A.numNodes(); ++i) {
      for (int s = A.rowBegin(i); s < A.rowEnd(i); ++s) {
        dense.block<3, 3>(3 * i, 3 * A.column(s)) = A.block(s);
      }
    }
  }
  Points reference() const {
    const Eigen::VectorXd x =
        dense.llt().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), b.size()));
    return Eigen::Map<const Points>(x.data(), 3, b.cols());
  }
};

TEST(BlockMatrix, ConstrainKeepsItSymmetricAndDecouples) {
  const System s;
  EXPECT_LT((s.dense - s.dense.transpose()).norm(), 1e-12 * s.dense.norm());
  EXPECT_EQ((s.dense.row(5).array() != 0.0).count(), 1);   // node 1, held
  EXPECT_EQ((s.dense.row(61).array() != 0.0).count(), 1);  // node 20, y held
  EXPECT_GT((s.dense.row(60).array() != 0.0).count(), 3);  // node 20, x free
}

TEST(BlockMatrix, MultipliesAsTheDenseMatrix) {
  const System s;
  Points y;
  s.A.multiply(s.b, &y);
  const Eigen::VectorXd expected =
      s.dense * Eigen::Map<const Eigen::VectorXd>(s.b.data(), s.b.size());
  EXPECT_LT((Eigen::Map<Eigen::VectorXd>(y.data(), y.size()) - expected).norm(),
            1e-13 * expected.norm());
}

TEST(BlockPcg, SolvesToTheToleranceAskedFor) {
  const System s;
  BlockPcg pcg(1000);
  int last = 0;
  for (const double tolerance : {1e-2, 1e-6, 1e-12}) {
    Points x, Ax;
    const LinearReport report = pcg.solve(s.A, s.b, tolerance, &x);
    EXPECT_EQ(report.status, SolveStatus::kConverged);
    s.A.multiply(x, &Ax);
    EXPECT_LE((s.b - Ax).norm(), 1.01 * tolerance * s.b.norm());
    EXPECT_GT(report.iterations, last);
    last = report.iterations;
  }
}

TEST(BlockPcg, SaysWhatIsWrong) {
  System s;
  Points x;
  BlockPcg short_of_breath(2);
  EXPECT_EQ(short_of_breath.solve(s.A, s.b, 1e-12, &x).status, SolveStatus::kIterationLimit);
  EXPECT_GT(x.cwiseProduct(s.b).sum(), 0.0);  // still a direction of descent
  BlockPcg pcg(1000);
  Points nan = s.b;
  nan(0, 30) = std::nan("");
  EXPECT_EQ(pcg.solve(s.A, nan, 1e-6, &x).status, SolveStatus::kNonFinite);
  // Indefinite, with a positive diagonal.
  for (int i = 17; i < 20; ++i) s.A.block(s.A.diagonal(i)) *= 0.3;
  EXPECT_EQ(pcg.solve(s.A, s.b, 1e-6, &x).status, SolveStatus::kNotPositiveDefinite);
}

TEST(CholmodSolver, AgreesWithADenseSolve) {
  const System s;
  CholmodSolver cholmod;
  for (int again = 0; again < 2; ++again) {
    Points x;
    EXPECT_EQ(cholmod.solve(s.A, s.b, 0.0, &x).status, SolveStatus::kConverged);
    EXPECT_LT((x - s.reference()).norm(), 1e-11 * x.norm());
  }
}

TEST(CholmodSolver, SaysWhatIsWrongAndRecovers) {
  const System s;
  CholmodSolver cholmod;
  Points x;
  fem::BlockMatrix indefinite = s.A;
  indefinite.block(indefinite.diagonal(20)) *= -1.0;
  EXPECT_EQ(cholmod.solve(indefinite, s.b, 0.0, &x).status, SolveStatus::kNotPositiveDefinite);
  indefinite.block(indefinite.diagonal(20))(0, 0) = std::nan("");
  EXPECT_EQ(cholmod.solve(indefinite, s.b, 0.0, &x).status, SolveStatus::kNonFinite);
  EXPECT_EQ(cholmod.solve(s.A, s.b, 0.0, &x).status, SolveStatus::kConverged);
  EXPECT_LT((x - s.reference()).norm(), 1e-11 * x.norm());
}

}  // namespace
}  // namespace palpate::solver
