// SPDX-License-Identifier: GPL-3.0-or-later
// Rank-one updates of a stiffness over many nodes: products, constraints, solves, bytes.
#include "palpate/fem/rank_ones.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "palpate/fem/elasticity.h"
#include "palpate/fem/supports.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/stale_pcg.h"
#include "support/random.h"

namespace palpate::solver::rank_ones_test {
namespace {

constexpr int kNumNodes = 64;  // of a cube of three cells a side

Eigen::VectorXd flat(const Points& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), x.size());
}

// A held cube, two volumes of which are resisted by much more than the cube itself.
struct System {
  explicit System(const std::string& element) {
    test::Random random;
    const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(3));
    const auto body = fem::makeElasticity(
        element, mesh,
        fem::Composition::uniform(material::makeMaterial(
            "stable_neo_hookean", {{"young_modulus", {5e3}}, {"poisson_ratio", {0.45}}})));
    A = body->makeMatrix();
    body->hessian(mesh.points, fem::Tangent::kExact, &A);
    fem::FreeMask free = fem::FreeMask::Ones(3, kNumNodes);
    free.leftCols(16).setZero();
    free(1, 20) = 0.0;
    fem::Stiffness elastic = A;
    elastic.constrain(free);
    dense = denseOf(elastic);
    for (const int first : {3, 30}) {
      std::vector<int> nodes;
      for (int i = first; i < first + 30; ++i) nodes.push_back(i);
      const Points a = random.points(30, 1.0);
      A.addRankOne(nodes, a, first == 3 ? 2e3 : 7e4);
      Points all = Points::Zero(3, kNumNodes);
      for (int i = 0; i < 30; ++i) all.col(first + i) = a.col(i).cwiseProduct(free.col(first + i));
      dense += (first == 3 ? 2e3 : 7e4) * flat(all) * flat(all).transpose();
    }
    A.constrain(free);
    b = random.points(kNumNodes, 1.0).cwiseProduct(free);
  }
  static Eigen::MatrixXd denseOf(const fem::Stiffness& A) {
    Eigen::MatrixXd dense(3 * kNumNodes, 3 * kNumNodes);
    for (Eigen::Index c = 0; c < dense.cols(); ++c) {
      Points unit = Points::Zero(3, kNumNodes), column;
      unit.data()[c] = 1.0;
      A.multiply(unit, &column);
      dense.col(c) = flat(column);
    }
    return dense;
  }
  Points reference() const {
    const Eigen::VectorXd x = dense.llt().solve(flat(b));
    return Eigen::Map<const Points>(x.data(), 3, kNumNodes);
  }
  void expectSolvedBy(LinearSolver* solver) const {
    Points x;
    EXPECT_EQ(solver->solve(A, b, 1e-10, &x).status, SolveStatus::kConverged);
    const Points expected = reference();
    EXPECT_LT((x - expected).norm(), 1e-7 * expected.norm());  // the condition is below 1e3
  }

  fem::Stiffness A;
  Points b;
  Eigen::MatrixXd dense;
};

class RankOnes : public ::testing::TestWithParam<std::string> {
 protected:
  const System s{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Elements, RankOnes, ::testing::Values("tet4", "anp", "p1p1"),
                         [](const auto& element) { return element.param; });

TEST_P(RankOnes, MultiplyScaleAndAreConstrainedAsADenseMatrix) {
  EXPECT_LT((System::denseOf(s.A) - s.dense).norm(), 1e-13 * s.dense.norm());
  fem::Stiffness twice = s.A;
  twice.scale(2.0);
  EXPECT_LT((System::denseOf(twice) - 2.0 * s.dense).norm(), 1e-13 * s.dense.norm());
  twice.forgetAdded();
  EXPECT_TRUE(twice.rankOnes().empty());
}

TEST_P(RankOnes, AreSolvedWithByConjugateGradients) {
  BlockPcg pcg(1000);
  s.expectSolvedBy(&pcg);
  // Two volumes are two eigenvalues 1e4 times the others. Each asks at most for the iterations of
  // four decades of the residual [van der Sluis, van der Vorst 1986, sec. 5]; three are asked for.
  fem::Stiffness without = s.A;
  without.forgetAdded();
  Points x;
  const int alone = BlockPcg(1000).solve(without, s.b, 1e-3, &x).iterations;
  const int both = BlockPcg(1000).solve(s.A, s.b, 1e-3, &x).iterations;
  std::printf("%s: %d iterations without them, %d with\n", GetParam().c_str(), alone, both);
  EXPECT_LE(both, alone + 2 * (4 * alone / 3 + 1));
}

TEST_P(RankOnes, AreSolvedWithByFactors) {
  CholmodSolver direct;
  s.expectSolvedBy(&direct);
  StalePcg stale(s.A, 1000, false);
  stale.prepare(s.A);
  stale.beginCycle(0.01);
  s.expectSolvedBy(&stale);
}

TEST_P(RankOnes, ComeBackFromBytes) {
  StateWriter out;
  s.A.save(&out);
  fem::Stiffness again = s.A;
  again.setZero();
  const std::string bytes = out.bytes();
  StateReader in(bytes);
  again.restore(&in);
  in.finish();
  EXPECT_EQ(System::denseOf(again), System::denseOf(s.A));
}

}  // namespace
}  // namespace palpate::solver::rank_ones_test
