// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace palpate::enrichment {

/// Interpolates values of k samples at a feature by Gaussian kernels of width sigma [Bounik,
/// Shamsi, Sedaaghi 2020, (1)-(4)]:
///
///     phi_ij = exp(-|c_i - c_j|^2 / (2 sigma^2)),  a = A phi(c) / sum(A phi(c)),  x = X a
///
/// A is the non-negative matrix with the least |Phi A - I|_F, column by column; negative entries of
/// the inverse would turn pushes into pulls. The source normalises kernels instead of weights, so
/// samples do not reproduce themselves; its (3) is lost.
class KernelRegressor {
 public:
  /// `features`: r x k, one sample per column; `sigma` > 0 in their unit.
  /// @throws std::invalid_argument without samples, or for another sigma.
  KernelRegressor(Eigen::MatrixXd features, double sigma);

  /// Non-negative weights of the samples at a feature (r), with sum 1. If all kernels underflow,
  /// the weight of the nearest sample is 1. Repeated calls do not allocate.
  void weights(const Eigen::VectorXd& feature, Eigen::VectorXd* weights);

  /// Weights of all features, one column each.
  Eigen::MatrixXd weights(const Eigen::MatrixXd& features);

  /// Kernel of the nearest sample at the last feature, in [0, 1]: a measure of confidence.
  double nearness() const { return nearness_; }

  /// Squared distances to the samples.
  void squareDistances(const Eigen::VectorXd& feature, Eigen::VectorXd* squares) const;

  Eigen::Index numSamples() const { return features_.cols(); }
  const Eigen::MatrixXd& mixing() const { return A_; }  ///< A, k x k.

 private:
  Eigen::MatrixXd features_, A_;
  double half_precision_;  // 1/(2 sigma^2)
  double nearness_ = 0.0;
  Eigen::VectorXd squares_, kernels_;
};

/// The non-negative A with the least |Phi A - I|_F; k x k.
Eigen::MatrixXd nonNegativeInverse(const Eigen::MatrixXd& Phi);

}  // namespace palpate::enrichment
