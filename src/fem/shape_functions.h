// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace palpate::fem {

/// Shape functions of tetrahedra with N nodes by the barycentric coordinates w = (w0 .. w3), sum 1,
/// and an integration rule. Nodes: corners, then mid-edge nodes of 01 12 20 03 13 23.
template <int N>
struct Tetrahedron;

/// Linear; one point.
template <>
struct Tetrahedron<4> {
  static constexpr int kPoints = 1;
  static Eigen::Vector4d point(int) { return Eigen::Vector4d::Constant(0.25); }
  static Eigen::Vector4d values(const Eigen::Vector4d& w) { return w; }
  /// d N_a / d w_k, with the w as independent.
  static Eigen::Matrix4d derivatives(const Eigen::Vector4d&) { return Eigen::Matrix4d::Identity(); }
  /// Fraction of the element's mass at each node.
  static Eigen::Vector4d massFractions() { return Eigen::Vector4d::Constant(0.25); }
};

/// Quadratic; four points, of order 2 [Zienkiewicz, Taylor, Zhu 2005, table 5.4]. Masses in
/// proportion to the diagonal of the consistent mass matrix [Hinton, Rock, Zienkiewicz 1976], all
/// positive.
template <>
struct Tetrahedron<10> {
  static constexpr int kPoints = 4;
  static constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  using Values = Eigen::Matrix<double, 10, 1>;
  using Derivatives = Eigen::Matrix<double, 10, 4>;

  static Eigen::Vector4d point(int q) {
    Eigen::Vector4d w = Eigen::Vector4d::Constant(0.1381966011250105);  // (5 - sqrt 5)/20
    w[q] = 0.5854101966249685;                                          // (5 + 3 sqrt 5)/20
    return w;
  }
  static Values values(const Eigen::Vector4d& w) {
    Values n;
    for (int a = 0; a < 4; ++a) n[a] = w[a] * (2.0 * w[a] - 1.0);
    for (int k = 0; k < 6; ++k) n[4 + k] = 4.0 * w[kEdges[k][0]] * w[kEdges[k][1]];
    return n;
  }
  static Derivatives derivatives(const Eigen::Vector4d& w) {
    Derivatives d = Derivatives::Zero();
    for (int a = 0; a < 4; ++a) d(a, a) = 4.0 * w[a] - 1.0;
    for (int k = 0; k < 6; ++k) {
      d(4 + k, kEdges[k][0]) = 4.0 * w[kEdges[k][1]];
      d(4 + k, kEdges[k][1]) = 4.0 * w[kEdges[k][0]];
    }
    return d;
  }
  static Values massFractions() {
    Values m;
    m << 1.0, 1.0, 1.0, 1.0, 16.0 / 3.0, 16.0 / 3.0, 16.0 / 3.0, 16.0 / 3.0, 16.0 / 3.0, 16.0 / 3.0;
    return m / 36.0;
  }
};

}  // namespace palpate::fem
