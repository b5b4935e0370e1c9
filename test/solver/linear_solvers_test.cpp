// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "palpate/fem/elasticity.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/potential.h"
#include "support/random.h"

namespace palpate::solver::linear_solvers_test {
namespace {

// A cube of n cells a side. "ELEMENT_two": of two solids, so that nodes between have two pressures.
std::unique_ptr<fem::Elasticity> makeCube(const std::string& name, int n, mesh::TetMesh* mesh) {
  const auto solid = [](double young_modulus) {
    return material::Solid{
        material::makeMaterial("stable_neo_hookean",
                               {{"young_modulus", {young_modulus}}, {"poisson_ratio", {0.45}}}),
        1000.0,
        {}};
  };
  const std::string element = name.substr(0, name.find('_'));
  if (fem::isQuadratic(element)) n = (n + 1) / 2;
  *mesh = fem::meshFor(element, mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(n)));
  fem::Composition solids{{solid(5e3)}, {}, {}};
  if (name.find("_two") != std::string::npos) {
    solids.solids.push_back(solid(8e3));
    for (Eigen::Index t = 0; t < mesh->tets.cols(); ++t) {
      solids.solid_of.push_back(mesh->points(0, mesh->tets(0, t)) < 0.05 ? 0 : 1);
    }
  }
  return fem::makeElasticity(element, *mesh, solids);
}

// Stiffness of a held, bent box: what the solvers meet.
struct System {
  fem::Stiffness A;
  Points b;
  Eigen::MatrixXd dense;

  explicit System(const std::string& element = "tet4", int n = 3) {
    test::Random random;
    mesh::TetMesh mesh;
    const auto body = makeCube(element, n, &mesh);
    A = body->makeMatrix();
    body->hessian(mesh.points + random.points(mesh.numPoints(), 0.001), fem::Tangent::kExact, &A);
    fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
    free.leftCols((n + 1) * (n + 1)).setZero();
    free(1, n == 3 ? 20 : 5) = 0.0;
    A.constrain(free);
    b = random.points(mesh.numPoints(), 1.0).cwiseProduct(free);
    dense.setZero(b.size(), b.size());
    const fem::BlockMatrix& blocks = A.blocks();
    for (int i = 0; i < A.numNodes(); ++i) {
      for (int s = blocks.rowBegin(i); s < blocks.rowEnd(i); ++s) {
        dense.block<3, 3>(3 * i, 3 * blocks.column(s)) = blocks.block(s);
      }
    }
    if (A.hasVolume()) addVolume(A.volume());
  }
  Points reference() const {
    const Eigen::VectorXd x =
        dense.llt().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), b.size()));
    return Eigen::Map<const Points>(x.data(), 3, b.cols());
  }

 private:
  // B^T M B, M column by column.
  void addVolume(const fem::VolumeStiffness& volume) {
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(volume.numRows(), dense.cols()),
                    M(B.rows(), B.rows());
    for (Eigen::Index p = 0; p < volume.numRows(); ++p) {
      for (int k = volume.pattern->start[p]; k < volume.pattern->start[p + 1]; ++k) {
        B.block<1, 3>(p, 3 * volume.pattern->node[k]) = volume.rows.col(k).transpose();
      }
      Eigen::VectorXd column;
      volume.metric->apply(Eigen::VectorXd::Unit(B.rows(), p), &column);
      M.col(p) = column;
    }
    dense += volume.factor * B.transpose() * M * B;
  }
};

TEST(BlockMatrix, ConstrainKeepsItSymmetricAndDecouples) {
  const System s;
  EXPECT_LT((s.dense - s.dense.transpose()).norm(), 1e-12 * s.dense.norm());
  EXPECT_EQ((s.dense.row(5).array() != 0.0).count(), 1);   // node 1, held
  EXPECT_EQ((s.dense.row(61).array() != 0.0).count(), 1);  // node 20, y held
  EXPECT_GT((s.dense.row(60).array() != 0.0).count(), 3);  // node 20, x free
}

class EveryStiffness : public ::testing::TestWithParam<std::string> {
 protected:
  const System s{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Elements, EveryStiffness,
                         ::testing::Values("tet4", "anp", "p1p1", "tet10p", "anp_two", "p1p1_two",
                                           "tet10p_two"),
                         [](const auto& element) { return element.param; });

TEST_P(EveryStiffness, MultipliesAsTheDenseMatrix) {
  Points y;
  s.A.multiply(s.b, &y);
  const Eigen::VectorXd expected =
      s.dense * Eigen::Map<const Eigen::VectorXd>(s.b.data(), s.b.size());
  EXPECT_LT((Eigen::Map<Eigen::VectorXd>(y.data(), y.size()) - expected).norm(),
            1e-13 * expected.norm());
}

TEST_P(EveryStiffness, ScalesEverything) {
  fem::Stiffness twice = s.A;
  twice.scale(2.0);
  Points y, y_twice;
  s.A.multiply(s.b, &y);
  twice.multiply(s.b, &y_twice);
  EXPECT_LT((y_twice - 2.0 * y).norm(), 1e-15 * y_twice.norm());
}

TEST_P(EveryStiffness, IsSolvedByConjugateGradients) {
  BlockPcg pcg(2000);
  Points x;
  EXPECT_EQ(pcg.solve(s.A, s.b, 1e-12, &x).status, SolveStatus::kConverged);
  EXPECT_LT((x - s.reference()).norm(), 1e-9 * x.norm());
}

TEST_P(EveryStiffness, IsSolvedByCholmodAgainAndAgain) {
  CholmodSolver cholmod;
  for (int again = 0; again < 2; ++again) {
    Points x;
    EXPECT_EQ(cholmod.solve(s.A, s.b, 0.0, &x).status, SolveStatus::kConverged);
    EXPECT_LT((x - s.reference()).norm(), 1e-10 * x.norm());
  }
}

TEST_P(EveryStiffness, IsRefusedByCholmodWhereItIsIndefinite) {
  fem::Stiffness indefinite = s.A;
  indefinite.blocks().block(indefinite.blocks().diagonal(30)).diagonal().array() -= 1e3;
  CholmodSolver cholmod;
  Points x;
  EXPECT_EQ(cholmod.solve(indefinite, s.b, 0.0, &x).status, SolveStatus::kNotPositiveDefinite);
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

// Large enough that threads share the work.
class LargeStiffness : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Elements, LargeStiffness,
                         ::testing::Values("tet4", "anp", "p1p1", "tet10p", "anp_two", "p1p1_two",
                                           "tet10p_two"),
                         [](const auto& element) { return element.param; });

TEST_P(LargeStiffness, GivesTheSameBitsWithAllInstructionsAndThreads) {
  mesh::TetMesh mesh;
  const auto body = makeCube(GetParam(), 13, &mesh);
  fem::Stiffness A = body->makeMatrix();
  body->hessian(mesh.points, fem::Tangent::kExact, &A);
  for (int i = 0; i < A.numNodes(); ++i) {
    A.blocks().block(A.blocks().diagonal(i)).diagonal().array() += 1.0;
  }
  test::Random random;
  const Points b = random.points(mesh.numPoints(), 1.0);
  Points first;
  const LinearReport expected = BlockPcg(500, nullptr, Isa::kBaseline).solve(A, b, 1e-3, &first);
  ASSERT_EQ(expected.status, SolveStatus::kConverged);
  for (const Isa isa : availableIsas()) {
    for (const int threads : {1, 2, 3}) {
      ThreadPool pool(threads);
      BlockPcg pcg(500, &pool, isa);
      for (int again = 0; again < 2; ++again) {
        Points x;
        const LinearReport report = pcg.solve(A, b, 1e-3, &x);
        EXPECT_EQ(report.iterations, expected.iterations);
        EXPECT_TRUE(x == first) << toString(isa) << ", " << threads << " threads";
      }
    }
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
  // Indefinite, with a positive diagonal: found by iterations, of which the ones before serve.
  for (int i = 17; i < 20; ++i) s.A.blocks().block(s.A.blocks().diagonal(i)) *= 0.3;
  EXPECT_EQ(pcg.solve(s.A, s.b, 1e-6, &x).status, SolveStatus::kIterationLimit);
  EXPECT_GT(x.cwiseProduct(s.b).sum(), 0.0);
  s.A.blocks().block(s.A.blocks().diagonal(17)) *= -1.0;
  EXPECT_EQ(pcg.solve(s.A, s.b, 1e-6, &x).status, SolveStatus::kNotPositiveDefinite);
}

TEST(CholmodErrors, SaysWhatIsWrongAndRecovers) {
  const System s;
  CholmodSolver cholmod;
  Points x;
  fem::Stiffness indefinite = s.A;
  fem::BlockMatrix& blocks = indefinite.blocks();
  blocks.block(blocks.diagonal(20)) *= -1.0;
  EXPECT_EQ(cholmod.solve(indefinite, s.b, 0.0, &x).status, SolveStatus::kNotPositiveDefinite);
  blocks.block(blocks.diagonal(20))(0, 0) = std::nan("");
  EXPECT_EQ(cholmod.solve(indefinite, s.b, 0.0, &x).status, SolveStatus::kNonFinite);
  EXPECT_EQ(cholmod.solve(s.A, s.b, 0.0, &x).status, SolveStatus::kConverged);
  EXPECT_LT((x - s.reference()).norm(), 1e-11 * x.norm());
}

// Small matrices are factored as L D L', which is there for indefinite ones as well.
TEST(CholmodErrors, FindsIndefiniteMatricesOfAllSizes) {
  for (const int n : {1, 2, 3, 6}) {
    const System s("tet4", n);
    CholmodSolver cholmod;
    Points x;
    EXPECT_EQ(cholmod.solve(s.A, s.b, 0.0, &x).status, SolveStatus::kConverged) << n;
    fem::Stiffness indefinite = s.A;
    indefinite.blocks().block(indefinite.blocks().diagonal(s.A.numNodes() - 1)) *= -1.0;
    EXPECT_EQ(cholmod.solve(indefinite, s.b, 0.0, &x).status, SolveStatus::kNotPositiveDefinite)
        << n;
  }
}

}  // namespace
}  // namespace palpate::solver::linear_solvers_test
