// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace palpate::tissue {

/// Anderson mixing of a fixed-point iteration x -> g(x) [Walker, Ni 2011, Anderson acceleration for
/// fixed-point iterations, sec. 2]: the next x is the combination of the last ones with least g(x)
/// - x.
class WaveMixing {
 public:
  static constexpr int kMaxDepth = 20;

  /// `size`: of x; `depth`: number of stored iterations, <= kMaxDepth; 0: x = g(x).
  WaveMixing(Eigen::Index size, int depth);
  void forget() { kept_ = next_ = 0, begun_ = false; }
  /// Replaces `g` = g(`x`) by the next x.
  void mix(const Eigen::VectorXd& x, Eigen::VectorXd* g);

 private:
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxDepth, kMaxDepth>;
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxDepth, 1>;

  int depth_;
  int kept_ = 0, next_ = 0;
  bool begun_ = false;
  Eigen::MatrixXd df_, dg_;  // differences of g - x and of g, a column per iteration
  Eigen::MatrixXd gram_;     // of df_
  Eigen::VectorXd f_, last_f_, last_g_;
};

}  // namespace palpate::tissue
