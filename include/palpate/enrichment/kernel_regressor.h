// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace palpate::enrichment {

/// Values at a feature from those at k samples, by Gaussian kernels of width sigma [Bounik, Shamsi,
/// Sedaaghi 2020, (1)-(4)]:
///
///     phi_ij = exp(-|c_i - c_j|^2 / (2 sigma^2)),  a = A phi(c) / sum(A phi(c)),  x = X a
///
/// A is the non-negative matrix with the least |Phi A - I|_F, column by column: entries of the
/// inverse that are negative would turn pushes into pulls. The source normalises the kernels
/// instead of the weights, which makes a sample not its own prediction; and its (3) is lost.
class KernelRegressor {
 public:
  /// `features`: r x k, a sample a column; `sigma` in their unit, above 0.
  /// @throws std::invalid_argument for no sample or another sigma.
  KernelRegressor(Eigen::MatrixXd features, double sigma);

  /// Weights of the samples at a feature (r), none negative, their sum 1. Where all samples are so
  /// far that no kernel is left, that of the nearest is 1.
  /// Allocates nothing when called again.
  void weights(const Eigen::VectorXd& feature, Eigen::VectorXd* weights);

  /// Of all features at once: a column each.
  Eigen::MatrixXd weights(const Eigen::MatrixXd& features);

  /// The kernel of the nearest sample at the last feature, in [0, 1]: how well that is known.
  double nearness() const { return nearness_; }

  /// Squares of the distances to the samples.
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
