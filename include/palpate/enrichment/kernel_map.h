// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/enrichment/response_samples.h"

namespace palpate::enrichment {

/// Kernel of functions y = A(x) d: a Gaussian times the inner product of the displacements, both
/// positive semidefinite,
///
///     k((x, d), (x', d')) = exp(-|x - x'|^2 / 2) d . d'
double responseKernel(const Vec6& x, const Vec3& d, const Vec6& other_x, const Vec3& other_d);

/// y = sum_m k((x, d), m) w_m over centres m: kernel ridge regression on a subset of the samples
/// [Rasmussen, Williams 2006, sec. 8.3.1]; y = 0 for d = 0.
class KernelMap {
 public:
  /// Without centres: y = 0.
  KernelMap() = default;
  /// For m centres: inputs 6 x m, displacements 3 x m, weights q x m.
  /// @throws std::invalid_argument for different numbers of centres, or none.
  KernelMap(const Eigen::Matrix<double, 6, Eigen::Dynamic>& inputs, const Points& displacements,
            const Eigen::MatrixXd& weights);

  /// Fits `samples` with at most `centres` of them, in the order of a pivoted Cholesky
  /// factorisation. The weights minimise |Y - W K|^2 + ridge W K_mm W^T.
  static KernelMap fit(const ResponseSamples& samples, Eigen::Index centres, double ridge);

  /// The first `rows` of y; does not allocate if y has that size.
  void evaluate(const Vec6& x, const Vec3& d, Eigen::Index rows, Eigen::VectorXd* y) const;

  /// 6 + q per centre: a centre's displacement is part of its input, scaled differently.
  Eigen::Index numParameters() const { return weights_.cols() * (6 + weights_.rows()); }

  const Eigen::Matrix<double, 6, Eigen::Dynamic>& inputs() const { return inputs_; }
  const Points& displacements() const { return displacements_; }
  const Eigen::MatrixXd& weights() const { return weights_; }

 private:
  Eigen::Matrix<double, 6, Eigen::Dynamic> inputs_;
  Points displacements_;
  Eigen::MatrixXd weights_;
};

/// Sum over samples of the squared prediction error by kernel ridge regression on all other groups.
/// Closed form for a group G, with C = K + ridge I and values Y: Y C^-1 restricted to G, times the
/// inverse of (C^-1)_GG [Rasmussen, Williams 2006, (5.12), of blocks]. `groups`: group of each
/// sample.
double leaveGroupsOutError(const ResponseSamples& samples, double ridge,
                           const std::vector<int>& groups);

}  // namespace palpate::enrichment
