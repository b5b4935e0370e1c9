// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/fem/stiffness.h"
#include "surface_pass.h"

namespace palpate::contact {

/// Of the twelve derivatives of a gap, those by the sample first, then by the triangle's corners.
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

inline Vec12 gapGradient(const SurfaceTouch& touch) {
  Vec12 g;
  g.head<3>() = touch.normal;
  for (int k = 0; k < 3; ++k) g.segment<3>(3 + 3 * k) = -touch.near.weights[k] * touch.normal;
  return g;
}

/// Likewise. What moves all alike changes nothing.
inline Mat12 gapHessian(const SurfaceTouch& touch, const Mat3& corners) {
  Mat12 H = Mat12::Zero();
  H.bottomRightCorner<9, 9>() =
      triangleDistanceHessian(corners, touch.near, touch.normal, touch.gap);
  for (int k = 1; k < 4; ++k) {
    for (int l = 1; l < 4; ++l) {
      const Mat3 block = H.block<3, 3>(3 * k, 3 * l);
      H.block<3, 3>(3 * k, 0) -= block;
      H.block<3, 3>(0, 3 * l) -= block;
      H.topLeftCorner<3, 3>() += block;
    }
  }
  return H;
}

/// Sum of second derivatives over touches of one pair of triangles, so that the matrix is searched
/// once per pair.
class TouchSum {
 public:
  explicit TouchSum(fem::Stiffness* K) : K_(K) {}
  ~TouchSum() { flush(); }
  TouchSum(const TouchSum&) = delete;
  TouchSum& operator=(const TouchSum&) = delete;

  void add(const SurfacePass& pass, const SurfaceTouch& touch, const SurfaceSample& sample,
           const Mat12& H) {
    Eigen::Matrix<int, 6, 1> nodes;
    nodes.head<3>() = sample.nodes.array() + pass.feels().first;
    nodes.tail<3>() =
        pass.other().fixed->triangles().col(touch.triangle).array() + pass.other().first;
    if (nodes != nodes_) {
      flush();
      nodes_ = nodes;
    }
    // How much of the twelve moves with each node.
    Eigen::Matrix<double, 6, 1> weights;
    weights << sample.weights, (touch.near.weights.array() != 0.0).cast<double>();
    weights_ = weights_.cwiseMax(weights);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        const double w = weights[i] * weights[j];
        if (w == 0.0) continue;
        H_.block<3, 3>(3 * i, 3 * j) +=
            w * H.block<3, 3>(i < 3 ? 0 : 3 * (i - 2), j < 3 ? 0 : 3 * (j - 2));
      }
    }
  }

 private:
  void flush() {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        if (weights_[i] == 0.0 || weights_[j] == 0.0) continue;
        K_->add(nodes_[i], nodes_[j], H_.block<3, 3>(3 * i, 3 * j));
      }
    }
    weights_.setZero();
    H_.setZero();
  }

  fem::Stiffness* K_;
  Eigen::Matrix<int, 6, 1> nodes_ = Eigen::Matrix<int, 6, 1>::Constant(-1);
  Eigen::Matrix<double, 6, 1> weights_ = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 18, 18> H_ = Eigen::Matrix<double, 18, 18>::Zero();
};

}  // namespace palpate::contact
