// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/enrichment/response_samples.h"

namespace palpate::enrichment {

/// The kernel of which functions y = A(x) d are sums: a Gaussian times the inner product of the
/// displacements, both positive semidefinite,
///
///     k((x, d), (x', d')) = exp(-|x - x'|^2 / 2) d . d'
double responseKernel(const Vec6& x, const Vec3& d, const Vec6& other_x, const Vec3& other_d);

/// y = sum_m k((x, d), m) w_m over centres m: kernel ridge regression on a subset of the samples
/// [Rasmussen, Williams 2006, sec. 8.3.1], in which nothing displaced answers nothing.
class KernelMap {
 public:
  /// Without centres: y = 0.
  KernelMap() = default;
  /// Of the centres inputs 6 x m, displacements 3 x m and weights q x m.
  /// @throws std::invalid_argument where their numbers differ, or there is none.
  KernelMap(const Eigen::Matrix<double, 6, Eigen::Dynamic>& inputs, const Points& displacements,
            const Eigen::MatrixXd& weights);

  /// Fits `samples` with `centres` of them, or all if there are fewer: those that a Cholesky
  /// factorisation with pivots takes first. The weights minimise |Y - W K|^2 + ridge W K_mm W^T.
  static KernelMap fit(const ResponseSamples& samples, Eigen::Index centres, double ridge);

  /// The first `rows` of y; allocates nothing where y has so many.
  void evaluate(const Vec6& x, const Vec3& d, Eigen::Index rows, Eigen::VectorXd* y) const;

  /// Of a centre 6 + q: its displacement is the input's, scaled otherwise.
  Eigen::Index numParameters() const { return weights_.cols() * (6 + weights_.rows()); }

  const Eigen::Matrix<double, 6, Eigen::Dynamic>& inputs() const { return inputs_; }
  const Points& displacements() const { return displacements_; }
  const Eigen::MatrixXd& weights() const { return weights_; }

 private:
  Eigen::Matrix<double, 6, Eigen::Dynamic> inputs_;
  Points displacements_;
  Eigen::MatrixXd weights_;
};

/// Sum over samples of the squares of what each is missed by, when those of other groups predict it
/// by ridge regression with the kernel. Of a group G, closed form, with C = K + ridge I and values
/// Y: Y C^-1 restricted to G, times the inverse of (C^-1)_GG [Rasmussen, Williams 2006, (5.12), of
/// blocks]. `groups`: of each sample its number.
double leaveGroupsOutError(const ResponseSamples& samples, double ridge,
                           const std::vector<int>& groups);

}  // namespace palpate::enrichment
