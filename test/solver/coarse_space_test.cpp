// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/coarse_space.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <set>

#include "palpate/fem/elasticity.h"
#include "palpate/mesh/hilbert_order.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/potential.h"
#include "solver/chunks.h"
#include "support/random.h"

namespace palpate::solver::coarse_space_test {
namespace {

// A cube of 15 cells a side, 4096 nodes, held below, where a step of 10 ms has begun; some nodes of
// its top held by something stiff, as a touch does.
class Cube : public ::testing::TestWithParam<std::string> {
 protected:
  static constexpr int kCells = 15;

  Cube() {
    const auto law = material::makeMaterial("stable_neo_hookean",
                                            {{"young_modulus", {5e3}}, {"poisson_ratio", {0.45}}});
    mesh = fem::meshFor(
        GetParam(), mesh::boxMesh(Vec3::Constant(0.1),
                                  Eigen::Vector3i::Constant(GetParam() == "tet10p" ? 8 : kCells)));
    body = fem::makeElasticity(GetParam(), mesh, fem::Composition::uniform(law));
    free.setOnes(3, mesh.numPoints());
    b.setZero(3, mesh.numPoints());
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) < 1e-9) free.col(i).setZero();
      if (mesh.points(2, i) < 0.1 - 1e-9) continue;
      if ((mesh.points.col(i) - Vec3(0.05, 0.05, 0.1)).norm() < 0.025) touched.push_back(i);
    }
    for (const Eigen::Index i : touched) b.col(i) = Vec3(0.1, 0.0, -1.0);
    A = matrix(0.0);
  }
  // With a touch of that stiffness [N/m].
  fem::Stiffness matrix(double touch) const {
    fem::Stiffness K = body->makeMatrix();
    body->hessian(mesh.points, fem::Tangent::kExact, &K);
    for (int i = 0; i < K.numNodes(); ++i) {
      K.blocks().block(K.blocks().diagonal(i)).diagonal().array() += body->masses()[i] / 1e-4;
    }
    for (const Eigen::Index i : touched) {
      K.blocks().block(K.blocks().diagonal(static_cast<int>(i)))(2, 2) += touch;
    }
    K.constrain(free);
    return K;
  }
  // That has learnt from this matrix.
  BlockPcg solverOf(const fem::Stiffness& K) const {
    BlockPcg pcg(1000, nullptr, bestIsa(), mesh.points);
    pcg.takePattern(K);
    EXPECT_TRUE(pcg.learnsFromRest(true));
    pcg.learnFromRest(K);
    return pcg;
  }
  // Of conjugate gradients with the inverses of the diagonal blocks alone.
  int plainIterations(const fem::Stiffness& K, double tolerance) const {
    std::vector<Mat3> D;
    K.diagonal(&D);
    for (Mat3& block : D) block = block.inverse().eval();
    const auto preconditioned = [&](const Points& r) {
      Points z(3, r.cols());
      for (Eigen::Index i = 0; i < r.cols(); ++i) z.col(i) = D[i] * r.col(i);
      return z;
    };
    Points r = b, z = preconditioned(r), p = z, Ap;
    double rz = r.cwiseProduct(z).sum();
    int iterations = 0;
    for (; r.norm() > tolerance * b.norm(); ++iterations) {
      K.multiply(p, &Ap);
      r -= rz / p.cwiseProduct(Ap).sum() * Ap;
      z = preconditioned(r);
      const double last = rz;
      rz = r.cwiseProduct(z).sum();
      p = z + rz / last * p;
    }
    return iterations;
  }

  mesh::TetMesh mesh;
  std::unique_ptr<fem::Elasticity> body;
  fem::FreeMask free;
  std::vector<Eigen::Index> touched;
  fem::Stiffness A;
  Points b;
};

INSTANTIATE_TEST_SUITE_P(Elements, Cube, ::testing::Values("tet4", "anp", "p1p1", "tet10p"),
                         [](const auto& element) { return element.param; });

TEST_P(Cube, TakesFewerIterations) {
  BlockPcg pcg = solverOf(A);
  Points x, Ax;
  const LinearReport report = pcg.solve(A, b, 1e-3, &x);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_LT(report.iterations, 0.8 * plainIterations(A, 1e-3));
  A.multiply(x, &Ax);
  EXPECT_LE((b - Ax).norm(), 1.01e-3 * b.norm());
}

TEST_P(Cube, ServesMatricesThatCameLater) {
  const fem::Stiffness touching = matrix(2e4);
  BlockPcg pcg = solverOf(A), fresh = solverOf(touching);
  Points x;
  const int with_old = pcg.solve(touching, b, 1e-3, &x).iterations;
  const int with_own = fresh.solve(touching, b, 1e-3, &x).iterations;
  EXPECT_LT(with_old, plainIterations(touching, 1e-3));
  EXPECT_LE(with_old, 1.3 * with_own);
}

TEST_P(Cube, GivesTheSameBitsWithAllInstructionsAndThreads) {
  const fem::Stiffness touching = matrix(2e4);
  Points first;
  const LinearReport expected = solverOf(A).solve(touching, b, 1e-3, &first);
  for (const Isa isa : availableIsas()) {
    for (const int threads : {1, 2, 3}) {
      ThreadPool pool(threads);
      BlockPcg pcg(1000, &pool, isa, mesh.points);
      pcg.takePattern(A);
      pcg.learnFromRest(A);
      for (int again = 0; again < 2; ++again) {
        Points x;
        EXPECT_EQ(pcg.solve(touching, b, 1e-3, &x).iterations, expected.iterations);
        EXPECT_TRUE(x == first) << toString(isa) << ", " << threads << " threads";
      }
    }
  }
}

TEST_P(Cube, HeldComponentsStay) {
  BlockPcg pcg = solverOf(A);
  Points x;
  pcg.solve(A, b, 1e-8, &x);
  EXPECT_TRUE((x.array() * (1.0 - free.array()) == 0.0).all());
}

// Against the formula, with nodes left out.
TEST_P(Cube, CorrectsAsTheDenseMatricesSay) {
  fem::Stiffness touching = matrix(2e4);
  if (touching.hasVolume()) {  // of a metric that is not diagonal it knows what stands for it
    const Eigen::VectorXd weights = touching.volume().metric->weights();
    touching.volume().metric =
        std::make_shared<fem::PressureMetric>(fem::PressureMetric::diagonal(weights));
  }
  std::vector<int> lengths;
  for (int i = 0; i < A.numNodes(); ++i) {
    lengths.push_back(A.blocks().rowEnd(i) - A.blocks().rowBegin(i));
  }
  const SliceOrder nodes(lengths, mesh::hilbertOrder(mesh.points));
  CoarseSpace coarse(touching, mesh.points, nodes, pcgKernels(bestIsa()));

  const std::set<Eigen::Index> out(touched.begin(), touched.end());
  const CoarseGroups groups(mesh.points, nodes, std::max(64, (A.numNodes() + 63) / 64));
  // The motions of rigid bodies, around any point: they span the same.
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(b.size(), 6 * groups.count());
  for (int i = 0; i < A.numNodes(); ++i) {
    if (out.count(i) > 0) continue;
    const Vec3 arm = (mesh.points.col(i) - Vec3(0.05, 0.05, 0.05)) / 0.03;
    for (int q = kGroupsOfANode * i; q < kGroupsOfANode * (i + 1); ++q) {
      for (int c = 0; c < 3; ++c) {
        const int at = 6 * groups.group[q] + c;
        P(3 * i + c, at) += groups.weight[q] * free(c, i);
        P.block<3, 1>(3 * i, at + 3) +=
            groups.weight[q] * Vec3::Unit(c).cross(arm).cwiseProduct(free.col(i).matrix());
      }
    }
  }
  Eigen::MatrixXd AP(b.size(), P.cols());
  Points Ax;
  for (Eigen::Index k = 0; k < P.cols(); ++k) {
    const Points column = Eigen::Map<const Points>(P.col(k).data(), 3, b.cols());
    touching.multiply(column, &Ax);
    AP.col(k) = Eigen::Map<const Eigen::VectorXd>(Ax.data(), Ax.size());
  }
  test::Random random;
  const Points r = random.points(b.cols(), 1.0).cwiseProduct(free);
  AlignedVector<double> in_slices(static_cast<std::size_t>(3 * kSlice) * nodes.numSlices(), 0.0);
  for (int i = 0; i < A.numNodes(); ++i) {
    for (int c = 0; c < 3; ++c) in_slices[nodes.offset(i, 3) + kSlice * c] = r(c, i);
  }
  const Eigen::VectorXd r_c = P.transpose() * Eigen::Map<const Eigen::VectorXd>(r.data(), r.size());
  const Eigen::MatrixXd C = P.transpose() * AP;
  const Eigen::VectorXd y = C.completeOrthogonalDecomposition().solve(r_c);
  const double expected = r_c.dot(y);
  Chunks(nullptr).forAll(nodes.numSlices(), [&](int chunk, int begin, int end) {
    coarse.restrictTo(chunk, begin, end, in_slices.data());
  });
  EXPECT_NEAR(coarse.correct(), expected, 1e-4 * expected);
}

TEST_P(Cube, HasPartsInTheNearestGroupsThatSumToOne) {
  const SliceOrder nodes(std::vector<int>(static_cast<std::size_t>(mesh.numPoints()), 1),
                         mesh::hilbertOrder(mesh.points));
  for (const int size : {64, 100, 5000}) {
    const CoarseGroups groups(mesh.points, nodes, size);
    ASSERT_EQ(groups.count(), (nodes.count() + size - 1) / size);
    for (int i = 0; i < nodes.count(); ++i) {
      std::vector<double> distances;
      for (int g = 0; g < groups.count(); ++g) {
        distances.push_back((groups.middle.col(g) - mesh.points.col(i)).norm());
      }
      std::vector<double> sorted = distances;
      std::sort(sorted.begin(), sorted.end());
      double sum = 0.0;
      for (int q = kGroupsOfANode * i; q < kGroupsOfANode * (i + 1); ++q) {
        ASSERT_GE(groups.weight[q], 0.0);
        sum += groups.weight[q];
        if (groups.weight[q] == 0.0 || groups.count() <= kGroupsOfANode) continue;
        ASSERT_LE(distances[groups.group[q]], sorted[kGroupsOfANode - 1]);
        ASSERT_LE(groups.weight[q], (sorted[kGroupsOfANode] - distances[groups.group[q]]) /
                                        (sorted[kGroupsOfANode] - sorted[0]) * 1.02);
      }
      ASSERT_NEAR(sum, 1.0, 1e-12);
    }
  }
}

TEST(CoarseSpace, PaysWhereNewsHaveALongWayToGo) {
  const auto pays = [](const Vec3& size, const Eigen::Vector3i& cells, bool lasting) {
    const Mat3 turned = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()).matrix();
    return CoarseSpace::pays(turned * mesh::boxMesh(size, cells).points, lasting);
  };
  const Vec3 cube = Vec3::Constant(0.1), flap(0.06, 0.04, 0.003);
  EXPECT_FALSE(pays(cube, {7, 7, 7}, true));
  EXPECT_TRUE(pays(cube, {15, 15, 15}, true));
  EXPECT_FALSE(pays(cube, {15, 15, 15}, false));
  EXPECT_TRUE(pays(flap, {20, 13, 1}, true));
  EXPECT_TRUE(pays(flap, {36, 24, 2}, false));
  EXPECT_FALSE(CoarseSpace::pays(Points(3, 0), true));
}

}  // namespace
}  // namespace palpate::solver::coarse_space_test
