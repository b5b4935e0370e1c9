// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/kernel_regressor.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/springs/least_squares.h"

namespace palpate::enrichment {

KernelRegressor::KernelRegressor(Eigen::MatrixXd features, double sigma)
    : features_(std::move(features)), half_precision_(0.5 / (sigma * sigma)) {
  if (features_.cols() == 0) throw std::invalid_argument("there are no samples");
  if (!(sigma > 0.0) || !(half_precision_ < std::numeric_limits<double>::infinity())) {
    throw std::invalid_argument("sigma must be above 0, not " + std::to_string(sigma));
  }
  Eigen::MatrixXd Phi(numSamples(), numSamples());
  Eigen::VectorXd squares;
  for (Eigen::Index i = 0; i < numSamples(); ++i) {
    squareDistances(features_.col(i), &squares);
    Phi.col(i) = (-half_precision_ * squares).array().exp();
  }
  A_ = nonNegativeInverse(Phi);
}

void KernelRegressor::squareDistances(const Eigen::VectorXd& feature,
                                      Eigen::VectorXd* squares) const {
  squares->resize(numSamples());
  for (Eigen::Index j = 0; j < numSamples(); ++j) {
    (*squares)[j] = (features_.col(j) - feature).squaredNorm();
  }
}

void KernelRegressor::weights(const Eigen::VectorXd& feature, Eigen::VectorXd* weights) {
  squareDistances(feature, &squares_);
  Eigen::Index nearest = 0;
  const double least = squares_.minCoeff(&nearest);
  nearness_ = std::exp(-half_precision_ * least);
  // A common factor of the kernels cancels; the nearest one is scaled to 1 and cannot underflow.
  kernels_ = (-half_precision_ * (squares_.array() - least)).exp();
  weights->noalias() = A_ * kernels_;
  const double sum = weights->sum();
  if (sum > 0.0) {
    *weights /= sum;
  } else {
    weights->setZero();
    (*weights)[nearest] = 1.0;
  }
}

Eigen::MatrixXd KernelRegressor::weights(const Eigen::MatrixXd& features) {
  Eigen::MatrixXd all(numSamples(), features.cols());
  Eigen::VectorXd one;
  for (Eigen::Index i = 0; i < features.cols(); ++i) {
    weights(features.col(i), &one);
    all.col(i) = one;
  }
  return all;
}

Eigen::MatrixXd nonNegativeInverse(const Eigen::MatrixXd& Phi) {
  const springs::SparseMatrix sparse = Phi.sparseView(0.0, 0.0);
  const Eigen::VectorXd no_bound =
      Eigen::VectorXd::Constant(Phi.cols(), std::numeric_limits<double>::infinity());
  Eigen::MatrixXd A(Phi.cols(), Phi.rows());
  for (Eigen::Index j = 0; j < Phi.rows(); ++j) {
    A.col(j) =
        springs::boundedLeastSquares(sparse, Eigen::VectorXd::Unit(Phi.rows(), j), no_bound).x;
  }
  return A;
}

}  // namespace palpate::enrichment
