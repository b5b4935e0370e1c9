// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks outside the pattern of a stiffness: products, solves, and bodies that they couple.
#include "palpate/fem/couplings.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "palpate/fem/elasticity.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/inertia.h"
#include "palpate/solver/minimizer_list.h"
#include "palpate/solver/stale_pcg.h"
#include "palpate/solver/stiffness_factor.h"
#include "solver/kept_stiffness.h"
#include "support/random.h"
#include "tissue/methods/prescribed/sparse_assembly.h"

namespace palpate::solver::couplings_test {
namespace {

constexpr int kNumNodes = 64;  // of a cube of three cells a side

std::unique_ptr<fem::Elasticity> makeCube(const std::string& element, const mesh::TetMesh& mesh) {
  return fem::makeElasticity(
      element, mesh,
      fem::Composition::uniform(material::makeMaterial(
          "stable_neo_hookean", {{"young_modulus", {5e3}}, {"poisson_ratio", {0.45}}})));
}

Eigen::VectorXd flat(const Points& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), x.size());
}

// A held cube with a dense block over `tied` of its nodes, some next to each other and most not.
struct System {
  explicit System(const std::string& element, std::vector<int> tied = {17, 20, 35, 46, 52, 63}) {
    test::Random random;
    const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(3));
    const auto body = makeCube(element, mesh);
    A = body->makeMatrix();
    body->hessian(mesh.points, fem::Tangent::kExact, &A);
    fem::FreeMask free = fem::FreeMask::Ones(3, kNumNodes);
    free.leftCols(16).setZero();
    free(1, 20) = 0.0;
    fem::Stiffness elastic = A;
    elastic.constrain(free);
    const auto k = 3 * static_cast<Eigen::Index>(tied.size());
    Eigen::MatrixXd G = Eigen::MatrixXd::NullaryExpr(k, k, [&] { return random.uniform(-9, 9); });
    const Eigen::MatrixXd H = G * G.transpose();
    A.add(Eigen::Map<const Eigen::VectorXi>(tied.data(), k / 3), H);
    dense = denseOf(A);
    // Constrained as a dense matrix would be.
    const Eigen::VectorXd mask = flat(free);
    const double mean = [&] {
      std::vector<Mat3> own;
      for (int i = 0; i < kNumNodes; ++i) own.push_back(A.blocks().block(A.blocks().diagonal(i)));
      double sum = 0.0;
      for (const Mat3& block : own) sum += block.trace();
      return sum / (3.0 * kNumNodes);
    }();
    dense = mask.asDiagonal() * dense * mask.asDiagonal();
    dense.diagonal() += mean * (1.0 - mask.array()).matrix();
    A.constrain(free);
    b = random.points(kNumNodes, 1.0).cwiseProduct(free);
  }
  static Eigen::MatrixXd denseOf(const fem::Stiffness& A) {
    Eigen::MatrixXd dense(3 * kNumNodes, 3 * kNumNodes);
    for (Eigen::Index c = 0; c < dense.cols(); ++c) {
      Points unit = Points::Zero(3, kNumNodes), column;
      unit.data()[c] = 1.0;
      fem::Stiffness alone = A;
      alone.forgetAdded();
      alone.multiply(unit, &column);
      dense.col(c) = flat(column);
    }
    for (const fem::Couplings::Block& block : A.couplings().blocks()) {
      dense.block<3, 3>(3 * block.i, 3 * block.j) += block.values;
    }
    return dense;
  }
  Points reference() const {
    const Eigen::VectorXd x = dense.llt().solve(flat(b));
    return Eigen::Map<const Points>(x.data(), 3, kNumNodes);
  }

  fem::Stiffness A;
  Points b;
  Eigen::MatrixXd dense;
};

class Coupled : public ::testing::TestWithParam<std::string> {
 protected:
  const System s{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Elements, Coupled, ::testing::Values("tet4", "anp", "p1p1"),
                         [](const auto& element) { return element.param; });

TEST_P(Coupled, HoldsBesideThePatternOnlyWhatIsNotInIt) {
  ASSERT_FALSE(s.A.couplings().empty());
  for (const auto& [i, j] : s.A.couplings().pairs()) EXPECT_EQ(s.A.blocks().find(i, j), -1);
  EXPECT_LT(s.A.couplings().pairs().size(), 15U);  // of the six nodes' 15 pairs some are in it
  EXPECT_LT((s.dense - s.dense.transpose()).norm(), 1e-12 * s.dense.norm());
}

// Whichever was analysed first, and whichever last.
TEST_P(Coupled, CostsWhatItsOwnAnalysisSays) {
  fem::Stiffness alone = s.A;
  alone.forgetAdded();
  CholmodSolver one, other;
  const double seconds = one.seconds(alone), coupled = other.seconds(s.A);
  EXPECT_GT(coupled, seconds);
  EXPECT_EQ(one.seconds(s.A), coupled);
  EXPECT_EQ(one.seconds(alone), seconds);
  EXPECT_EQ(other.seconds(alone), seconds);
  EXPECT_EQ(other.seconds(s.A), coupled);
}

TEST_P(Coupled, MultipliesScalesAndIsConstrainedAsADenseMatrix) {
  Points y;
  s.A.multiply(s.b, &y);
  const Eigen::VectorXd expected = s.dense * flat(s.b);
  EXPECT_LT((flat(y) - expected).norm(), 1e-13 * expected.norm());
  fem::Stiffness twice = s.A;
  twice.scale(2.0);
  twice.multiply(s.b, &y);
  EXPECT_LT((flat(y) - 2.0 * expected).norm(), 1e-13 * expected.norm());
  twice.setZero();
  twice.multiply(s.b, &y);
  EXPECT_EQ(y.norm(), 0.0);
}

TEST_P(Coupled, IsSolvedByConjugateGradientsToTheSameBitsEverywhere) {
  Points first;
  for (const Isa isa : availableIsas()) {
    for (const int threads : {1, 2, 3}) {
      ThreadPool pool(threads);
      BlockPcg pcg(3000, &pool, isa);
      Points x;
      ASSERT_EQ(pcg.solve(s.A, s.b, 1e-11, &x).status, SolveStatus::kConverged);
      EXPECT_LT((x - s.reference()).norm(), 1e-8 * x.norm());
      if (first.size() == 0) first = x;
      EXPECT_TRUE(x == first) << toString(isa) << ", " << threads << " threads";
    }
  }
}

// Others are coupled from solve to solve, and the factor does not know of earlier ones.
TEST_P(Coupled, IsSolvedByCholmodWhoeverIsCoupled) {
  const System others(GetParam(), {19, 31, 44, 60}), none(GetParam(), {30});
  EXPECT_TRUE(none.A.couplings().empty());
  CholmodSolver cholmod;
  for (const System* system : {&s, &others, &none, &s}) {
    Points x, fresh;
    ASSERT_EQ(cholmod.solve(system->A, system->b, 0.0, &x).status, SolveStatus::kConverged);
    EXPECT_LT((x - system->reference()).norm(), 1e-10 * x.norm());
    CholmodSolver().solve(system->A, system->b, 0.0, &fresh);
    EXPECT_TRUE(x == fresh);
  }
}

TEST_P(Coupled, IsRefusedWhereTheCouplingsMakeItIndefinite) {
  fem::Stiffness indefinite = s.A;
  indefinite.add(18, 62, 1e4 * Mat3::Identity());
  indefinite.add(62, 18, 1e4 * Mat3::Identity());
  Points x;
  CholmodSolver cholmod;
  EXPECT_EQ(cholmod.solve(indefinite, s.b, 0.0, &x).status, SolveStatus::kNotPositiveDefinite);
  // Conjugate gradients find it on the way, and what they found before goes down.
  EXPECT_EQ(BlockPcg(3000).solve(indefinite, s.b, 1e-6, &x).status, SolveStatus::kIterationLimit);
  EXPECT_GT(x.cwiseProduct(s.b).sum(), 0.0);
  EXPECT_EQ(cholmod.solve(s.A, s.b, 0.0, &x).status, SolveStatus::kConverged);
}

TEST_P(Coupled, IsSolvedWithAStaleFactorAndAKeptOne) {
  const System others(GetParam(), {19, 31, 44, 60});
  StalePcg stale(s.A, 3000, false);
  stale.beginCycle(0.01);
  stale.prepare(others.A);
  Points x;
  const LinearReport report = stale.solve(s.A, s.b, 1e-11, &x);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_LT((x - s.reference()).norm(), 1e-8 * x.norm());
  stale.prepare(s.A);
  EXPECT_LE(stale.solve(s.A, s.b, 1e-8, &x).iterations, 3);  // its own factor
  const Eigen::MatrixXd kept = StiffnessFactor(s.A).solve(flat(s.b));
  EXPECT_LT((kept - flat(s.reference())).norm(), 1e-9 * kept.norm());
}

TEST_P(Coupled, IsAssembledForEigen) {
  if (GetParam() == "p1p1")
    GTEST_SKIP() << "p1p1 has a full pressure metric, and would be a full matrix for Eigen";
  const Eigen::MatrixXd assembled = tissue::assembleSparse(s.A);
  EXPECT_LT((assembled - s.dense).norm(), 1e-13 * s.dense.norm());
}

// A spring between two nodes that no element connects, or, as `length` says, a loose string.
struct Tie final : fem::EnergyTerm {
  int a = 21, b = 63;
  double stiffness = 40.0, length = 0.02;  // [N/m], [m]

  double stretch(const Points& x) const { return (x.col(a) - x.col(b)).norm() - length; }
  double value(const Points& x) const override { return 0.5 * stiffness * stretch(x) * stretch(x); }
  double addGradient(const Points& x, Points* g) const override {
    const Vec3 pull = stiffness * stretch(x) * (x.col(a) - x.col(b)).normalized();
    g->col(a) += pull;
    g->col(b) -= pull;
    return value(x);
  }
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override {
    const Vec3 n = (x.col(a) - x.col(b)).normalized();
    Mat3 H = stiffness * n * n.transpose();
    if (tangent == fem::Tangent::kExact || stretch(x) > 0.0) {
      H += stiffness * stretch(x) / (stretch(x) + length) * (Mat3::Identity() - n * n.transpose());
    }
    K->addPoint<2>(Eigen::Vector2i(a, b), Eigen::Vector2d(1.0, -1.0), H);
  }
};

struct Tied {
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(3));
  std::unique_ptr<fem::Elasticity> body = makeCube("anp", mesh);
  Tie tie;
  Inertia inertia;
  Potential potential{body.get(), {&tie, &inertia}, fem::FreeMask::Ones(3, kNumNodes), 1.0};

  Tied() {
    potential.free.leftCols(16).setZero();
    inertia.beginStep(mesh.points, 2e3, body->masses());
  }
};

class TiedBody : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Minimizers, TiedBody, ::testing::ValuesIn(minimizerNames()),
                         [](const auto& name) { return name.param; });

TEST_P(TiedBody, FindsItsMinimumWithFewIterationsAndTheSameBits) {
  NewtonSettings settings;
  settings.tolerance = 1e-9;
  settings.linear_tolerance = 1e-4;
  Points first;
  for (const int threads : {1, 2}) {
    Tied tied;
    ThreadPool pool(threads);
    const auto minimizer = makeMinimizer(GetParam(), {3000, &pool, true}, tied.body->makeMatrix());
    Points x = tied.mesh.points;
    minimizer->beginCycle(0.01);
    minimizer->prepare(tied.potential, x);
    NewtonReport report;
    for (int step = 1; step <= 4; ++step) {  // others are tied in each
      tied.tie.b = 63 - step;
      minimizer->beginCycle(0.01);
      report = minimizer->minimize(tied.potential, settings, &x);
      ASSERT_EQ(report.status, SolveStatus::kConverged) << step;
      EXPECT_LE(report.iterations, GetParam() == "lbfgs" ? 60 : 12) << step;
      Points g;
      tied.potential.gradient(x, &g);
      EXPECT_LE(g.cwiseProduct(tied.potential.free).norm(), settings.tolerance);
      EXPECT_LT(tied.tie.stretch(x), tied.tie.stretch(tied.mesh.points));
    }
    EXPECT_GT((x - tied.mesh.points).cwiseAbs().maxCoeff(), 1e-3);
    if (first.size() == 0) first = x;
    EXPECT_TRUE(x == first);
  }
}

TEST_P(TiedBody, PredictsWithWhatIsTied) {
  Tied tied;
  Points move = Points::Zero(3, kNumNodes);
  move.row(0).leftCols(16).setConstant(0.002);
  tied.inertia.beginStep(tied.mesh.points, 0.0, tied.body->masses());
  tied.tie.length = tied.tie.stretch(tied.mesh.points) + tied.tie.length;  // at rest
  const auto minimizer = makeMinimizer(GetParam(), {3000, nullptr, true}, tied.body->makeMatrix());
  Points x = tied.mesh.points;
  ASSERT_EQ(minimizer->predict(tied.potential, move, &x), SolveStatus::kConverged);
  Points shifted = tied.mesh.points;
  shifted.row(0).array() += 0.002;  // as a whole: no spring resists
  EXPECT_LT((x - shifted).cwiseAbs().maxCoeff(), 1e-9);
}

// The kept stiffness with couplings that come and go is the one of now.
TEST(KeptCouplings, HasTheCouplingsOfNow) {
  test::Random random;
  Tied tied;
  fem::Stiffness A = tied.body->makeMatrix();
  KeptStiffness kept(A);
  BlockPcg pcg(3000);
  Points x_kept;
  for (int k = 0; k < 6; ++k) {
    tied.tie.b = k == 3 ? 22 : 63 - k;  // once a neighbour
    const Points x = tied.mesh.points + random.points(kNumNodes, 1e-4);
    if (k == 0) x_kept = x;
    const auto assembled = kept.hessian(tied.potential, x, fem::Tangent::kConvexTerms, &A);
    EXPECT_EQ(A.couplings().blocks().size(), k == 3 ? 0U : 2U);
    EXPECT_EQ(assembled.kept, k > 0);
    fem::Stiffness expected = tied.body->makeMatrix();
    tied.body->hessian(x_kept, fem::Tangent::kExact, &expected);
    tied.potential.addTermHessians(x, fem::Tangent::kConvexTerms, &expected);
    expected.constrain(tied.potential.free);
    const Points b = random.points(kNumNodes, 1.0).cwiseProduct(tied.potential.free);
    Points Ab, expected_Ab, y, all;
    A.multiply(b, &Ab);
    expected.multiply(b, &expected_Ab);
    EXPECT_EQ(Ab, expected_Ab);
    if (assembled.changed) pcg.onlyChanged(*assembled.changed);
    ASSERT_EQ(pcg.solve(A, b, 1e-3, &y).status, SolveStatus::kConverged);
    BlockPcg(3000).solve(A, b, 1e-3, &all);
    EXPECT_EQ(y, all) << k;
  }
}

}  // namespace
}  // namespace palpate::solver::couplings_test
