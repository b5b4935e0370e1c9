// SPDX-License-Identifier: GPL-3.0-or-later
// Against Eigen's factors of the whole matrix, and where there is no solution.
#include "tissue/models/honeycomb/dense_saddle.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <utility>
#include <vector>

namespace palpate::tissue::dense_saddle_test {
namespace {

TEST(DenseSaddle, SolvesAsTheWholeMatrix) {
  DenseSaddle saddle;
  std::srand(7);
  for (const auto& [n, m] : {std::pair(12, 5), std::pair(4, 0), std::pair(30, 11)}) {
    const Eigen::MatrixXd half = Eigen::MatrixXd::Random(n, n), C = Eigen::MatrixXd::Random(m, n);
    const Eigen::MatrixXd H = half * half.transpose() + Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n + m, n + m);
    whole << H, -C.transpose(), C, Eigen::MatrixXd::Zero(m, m);
    const Eigen::VectorXd right = Eigen::VectorXd::Random(n + m);
    const Eigen::VectorXd expected = whole.fullPivLu().solve(-right);

    saddle.reset(n, m);
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b <= a; ++b) saddle.stiffness(a, b) = H(a, b);
      for (int c = 0; c < m; ++c) saddle.condition(c, a) = C(c, a);
    }
    ASSERT_TRUE(saddle.factor());
    const std::vector<double> g(right.data(), right.data() + n);
    std::vector<double> v(right.data() + n, right.data() + n + m), y, p;
    const double slope = saddle.solve(g, v, &y, &p);
    const Eigen::Map<Eigen::VectorXd> y_found(y.data(), n), p_found(p.data(), m);
    // Conditions give way by 1e-10.
    EXPECT_LT((y_found - expected.head(n)).norm(), 1e-7 * expected.norm());
    EXPECT_LT((p_found - expected.tail(m)).norm(), 1e-7 * expected.norm());
    EXPECT_NEAR(slope, -y_found.dot(H * y_found), 1e-9 * std::abs(slope));
  }
}

TEST(DenseSaddle, TellsWhenItIsNotPositive) {
  DenseSaddle saddle;
  saddle.reset(2, 0);
  saddle.stiffness(0, 0) = 1.0;
  saddle.stiffness(1, 0) = 2.0;
  saddle.stiffness(1, 1) = 1.0;
  EXPECT_FALSE(saddle.factor());
  saddle.stiffness(0, 0) = std::nan("");
  EXPECT_FALSE(saddle.factor());
}

}  // namespace
}  // namespace palpate::tissue::dense_saddle_test
