// SPDX-License-Identifier: GPL-3.0-or-later
#include "tissue/touch/dense_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <vector>

namespace palpate::tissue::dense_lu_test {
namespace {

TEST(DenseLu, SolvesWhatNeedsPivots) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const Eigen::Index n : {1, 2, 7, 60}) {
    Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); });
    if (n > 1) A(0, 0) = 0.0;
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(random); });
    Eigen::MatrixXd factor = A;
    Eigen::VectorXd x = b;
    Eigen::Map<Eigen::MatrixXd> factor_map(factor.data(), n, n);
    Eigen::Map<Eigen::VectorXd> x_map(x.data(), n);
    solveInPlace(factor_map, x_map);
    EXPECT_LT((A * x - b).norm(), 1e-12 * A.norm() * x.norm()) << n;
  }
}

TEST(DenseLu, LeavesNoNumberOfASingularMatrix) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Ones(2, 2);
  Eigen::VectorXd x(2);
  x << 1.0, 2.0;
  Eigen::Map<Eigen::MatrixXd> A_map(A.data(), 2, 2);
  Eigen::Map<Eigen::VectorXd> x_map(x.data(), 2);
  solveInPlace(A_map, x_map);
  EXPECT_FALSE(x.allFinite());
}

}  // namespace
}  // namespace palpate::tissue::dense_lu_test
