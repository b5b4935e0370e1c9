// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_mixing.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace palpate::tissue {
namespace {

constexpr double kRegularization = 1e-14;  // of the differences' scaled Gram matrix

}  // namespace

WaveMixing::WaveMixing(Eigen::Index size, int depth)
    : depth_(depth),
      df_(size, depth),
      dg_(size, depth),
      gram_(depth, depth),
      f_(size),
      last_f_(size),
      last_g_(size) {}

void WaveMixing::mix(const Eigen::VectorXd& x, Eigen::VectorXd* g) {
  if (depth_ == 0) return;
  f_ = *g - x;
  if (begun_) {
    df_.col(next_) = f_ - last_f_;
    dg_.col(next_) = *g - last_g_;
    kept_ = kept_ < depth_ ? kept_ + 1 : depth_;
    for (int k = 0; k < kept_; ++k) {
      gram_(k, next_) = gram_(next_, k) = df_.col(k).dot(df_.col(next_));
    }
    next_ = (next_ + 1) % depth_;
  }
  last_f_ = f_;
  last_g_ = *g;
  begun_ = true;
  if (kept_ == 0) return;
  SmallVector scale(kept_), weights(kept_);
  for (int k = 0; k < kept_; ++k) {
    scale[k] = gram_(k, k) > 0.0 ? 1.0 / std::sqrt(gram_(k, k)) : 0.0;
    weights[k] = scale[k] * df_.col(k).dot(f_);
  }
  Small normal(kept_, kept_);
  for (int k = 0; k < kept_; ++k) {
    for (int j = 0; j < kept_; ++j) normal(j, k) = scale[j] * gram_(j, k) * scale[k];
    normal(k, k) += kRegularization + (scale[k] == 0.0 ? 1.0 : 0.0);
  }
  weights = Eigen::LDLT<Small>(normal).solve(weights).eval();
  for (int k = 0; k < kept_; ++k) *g -= weights[k] * scale[k] * dg_.col(k);
}

}  // namespace palpate::tissue
