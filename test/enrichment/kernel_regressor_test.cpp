// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/kernel_regressor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

namespace palpate::enrichment::kernel_regressor_test {
namespace {

Eigen::MatrixXd someFeatures(int samples) {
  Eigen::MatrixXd features(6, samples);
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < 6; ++i) features(i, j) = std::sin(3.7 * i + 1.9 * j * j + 0.3 * i * j);
  }
  return features;
}

Eigen::MatrixXd kernels(const Eigen::MatrixXd& features, double sigma) {
  Eigen::MatrixXd Phi(features.cols(), features.cols());
  for (Eigen::Index i = 0; i < features.cols(); ++i) {
    for (Eigen::Index j = 0; j < features.cols(); ++j) {
      const double square = (features.col(i) - features.col(j)).squaredNorm();
      Phi(i, j) = std::exp(-square / (2.0 * sigma * sigma));
    }
  }
  return Phi;
}

TEST(KernelRegressor, MixesByTheBestMatrixWithoutNegativeEntries) {
  const Eigen::MatrixXd features = someFeatures(12), Phi = kernels(features, 1.0);
  ASSERT_LT(Phi.inverse().minCoeff(), -0.01);  // else there was nothing to do
  const Eigen::MatrixXd A = KernelRegressor(features, 1.0).mixing();
  EXPECT_GE(A.minCoeff(), 0.0);
  // Karush, Kuhn, Tucker: no entry could go down the slope.
  const Eigen::MatrixXd slope = Phi.transpose() * (Phi * A - Eigen::MatrixXd::Identity(12, 12));
  for (int i = 0; i < A.size(); ++i) {
    EXPECT_GT(slope(i), -1e-7);
    if (A(i) > 1e-9) {
      EXPECT_NEAR(slope(i), 0.0, 1e-7);
    }
  }
}

TEST(KernelRegressor, IsTheInverseWhereThatHasNoNegativeEntries) {
  const Eigen::MatrixXd features = someFeatures(8);
  const double narrow = 0.05;  // so that Phi is the identity to rounding
  EXPECT_LT((KernelRegressor(features, narrow).mixing() - Eigen::MatrixXd::Identity(8, 8)).norm(),
            1e-6);
}

TEST(KernelRegressor, PredictsASampleByItselfWithNarrowKernels) {
  const Eigen::MatrixXd features = someFeatures(8);
  KernelRegressor regressor(features, 0.05);
  Eigen::VectorXd weights;
  for (int j = 0; j < 8; ++j) {
    regressor.weights(features.col(j), &weights);
    EXPECT_NEAR((weights - Eigen::VectorXd::Unit(8, j)).norm(), 0.0, 1e-6);
  }
}

TEST(KernelRegressor, WeighsByPartsThatSumToOneHoweverFarTheSamplesAre) {
  const Eigen::MatrixXd features = someFeatures(8);
  Eigen::VectorXd weights;
  for (const double sigma : {0.01, 0.3, 3.0, 100.0}) {
    KernelRegressor regressor(features, sigma);
    for (const double away : {0.0, 1.0, 1e3, 1e8}) {
      regressor.weights(features.col(3) + away * Eigen::VectorXd::Ones(6), &weights);
      EXPECT_NEAR(weights.sum(), 1.0, 1e-12) << sigma << " " << away;
      EXPECT_GE(weights.minCoeff(), 0.0);
    }
  }
}

TEST(KernelRegressor, RefusesNoSamplesAndNoWidth) {
  EXPECT_THROW(KernelRegressor(Eigen::MatrixXd(6, 0), 1.0), std::invalid_argument);
  EXPECT_THROW(KernelRegressor(someFeatures(3), 0.0), std::invalid_argument);
  EXPECT_THROW(KernelRegressor(someFeatures(3), std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::enrichment::kernel_regressor_test
