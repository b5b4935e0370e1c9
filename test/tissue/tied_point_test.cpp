// SPDX-License-Identifier: GPL-3.0-or-later
// A held point of a triangle, against the system with multipliers.
#include "tissue/methods/prescribed/tied_point.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/random.h"

namespace palpate::tissue::tied_point_test {
namespace {

constexpr int kNodes = 6;
constexpr int kSize = 3 * kNodes;

struct Case {
  const char* name;
  Vec3 weights;
  int held;  // a component of node 1 that a support holds, or -1
};

class TiedPoints : public ::testing::TestWithParam<Case> {
 protected:
  TiedPoints() {
    const Eigen::MatrixXd B =
        Eigen::MatrixXd::NullaryExpr(kSize, kSize, [&] { return random_.uniform(-1.0, 1.0); });
    K_ = B.transpose() * B + Eigen::MatrixXd::Identity(kSize, kSize);
    if (GetParam().held >= 0) free_(GetParam().held, 1) = 0.0;
  }
  bool held(int component) const {
    return component == 3 + GetParam().held && GetParam().held >= 0;
  }
  // W' u = d, the held component left out; and u = 0 there.
  Eigen::MatrixXd conditions() const {
    Eigen::MatrixXd W = Eigen::MatrixXd::Zero(kSize, 3);
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) {
        W(3 * nodes_[k] + c, c) = GetParam().weights[k] * free_(c, nodes_[k]);
      }
    }
    return W;
  }

  test::Random random_;
  Eigen::MatrixXd K_;
  const Eigen::Vector3i nodes_{4, 1, 2};
  fem::FreeMask free_ = fem::FreeMask::Ones(3, kNodes);
};

INSTANTIATE_TEST_SUITE_P(Places, TiedPoints,
                         ::testing::Values(Case{"vertex", Vec3(1, 0, 0), -1},
                                           Case{"edge", Vec3(0.3, 0.7, 0), -1},
                                           Case{"face", Vec3(0.2, 0.5, 0.3), -1},
                                           Case{"near_a_vertex", Vec3(1e-7, 1.0 - 2e-7, 1e-7), -1},
                                           Case{"supported", Vec3(0.2, 0.5, 0.3), 1},
                                           Case{"supported_vertex", Vec3(0, 1, 0), 2}),
                         [](const auto& of) { return of.param.name; });

// [K W; W' 0] [u; -l] = [-g; d] at once.
TEST_P(TiedPoints, SolvesWhatMultipliersSolve) {
  Points g = random_.points(kNodes, 1.0);
  const Vec3 way = random_.vector(1.0);
  g = g.cwiseProduct(free_);
  Eigen::MatrixXd constrained = K_;
  for (int i = 0; i < kSize; ++i) {
    if (!held(i)) continue;
    constrained.row(i).setZero();
    constrained.col(i).setZero();
    constrained(i, i) = 1.0;
  }
  const Eigen::MatrixXd W = conditions();
  Eigen::MatrixXd KKT = Eigen::MatrixXd::Zero(kSize + 3, kSize + 3);
  KKT << constrained, W, W.transpose(), Eigen::Matrix3d::Zero();
  Eigen::VectorXd right(kSize + 3);
  right << -Eigen::Map<const Eigen::VectorXd>(g.data(), kSize), way;
  for (int c = 0; c < 3; ++c) {
    if (!W.col(c).isZero()) continue;  // nothing is tied
    KKT(kSize + c, kSize + c) = 1.0;
    right[kSize + c] = 0.0;
  }
  const Eigen::VectorXd expected = KKT.fullPivLu().solve(right);

  const TiedPoint point(nodes_, GetParam().weights, free_);
  EXPECT_EQ(point.free(), (W.colwise().norm().array() > 0.0).all());
  Points move = Points::Zero(3, kNodes);
  point.addMove(way, &move);
  const Eigen::VectorXd Km = K_ * Eigen::Map<const Eigen::VectorXd>(move.data(), kSize);
  Points rest = -(g + Eigen::Map<const Points>(Km.data(), 3, kNodes)).cwiseProduct(free_);
  point.reduce(&rest);
  Eigen::SparseMatrix<double> A = constrained.sparseView();
  point.reduce(&A);
  const Eigen::MatrixXd dense = A;
  EXPECT_LT((dense - dense.transpose()).norm(), 1e-12 * dense.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues().minCoeff(), 0.0);
  const Eigen::VectorXd v =
      dense.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(rest.data(), kSize));
  Points step = Eigen::Map<const Points>(v.data(), 3, kNodes).cwiseProduct(free_);
  point.expand(&step);
  step += move;
  const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(step.data(), kSize);
  EXPECT_LT((u - expected.head(kSize)).norm(), 1e-10 * expected.head(kSize).norm());
  EXPECT_LT((W.transpose() * u - right.tail(3)).norm(), 1e-12);

  // The gradient there: what the point leaves of it is nothing, and the force is the multiplier's.
  const Eigen::VectorXd after = K_ * u;
  Points gradient = (g + Eigen::Map<const Points>(after.data(), 3, kNodes)).cwiseProduct(free_);
  Vec3 expected_force = Vec3::Zero();
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 3; ++k) {
      expected_force[c] -= W(3 * nodes_[k] + c, c) * expected[kSize + c];
    }
  }
  EXPECT_LT((point.force(gradient) - expected_force).norm(), 1e-8 * (1.0 + expected_force.norm()));
  EXPECT_GT(point.nodalNorm(gradient), 0.0);
  point.balance(&gradient);
  EXPECT_LT(gradient.norm(), 1e-8 * K_.norm());
}

TEST(TiedPoint, HoldsNothingUnlessItIsOne) {
  const TiedPoint none;
  EXPECT_FALSE(none.free());
  Points g = Points::Ones(3, 4);
  none.balance(&g);
  none.reduce(&g);
  none.expand(&g);
  none.addMove(Vec3::Ones(), &g);
  EXPECT_EQ(g, Points::Ones(3, 4));
  EXPECT_EQ(none.force(g), Vec3::Zero());
}

}  // namespace
}  // namespace palpate::tissue::tied_point_test
