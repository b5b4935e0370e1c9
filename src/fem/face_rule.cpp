// SPDX-License-Identifier: GPL-3.0-or-later
#include "face_rule.h"

namespace palpate::fem {
namespace {

FacePoint linearPoint() {
  FacePoint point;
  point.weight = 0.5;
  point.N = Vec3::Constant(1.0 / 3.0);
  point.dN_dr = Vec3(-1.0, 1.0, 0.0);
  point.dN_ds = Vec3(-1.0, 0.0, 1.0);
  return point;
}

FacePoint quadraticPoint(const Vec3& w, double weight) {
  FacePoint point;
  point.weight = 0.5 * weight;
  point.N.resize(6);
  Eigen::Matrix<double, 6, 3> d = Eigen::Matrix<double, 6, 3>::Zero();  // by w
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    point.N[a] = w[a] * (2.0 * w[a] - 1.0);
    d(a, a) = 4.0 * w[a] - 1.0;
    point.N[3 + a] = 4.0 * w[a] * w[b];
    d(3 + a, a) = 4.0 * w[b];
    d(3 + a, b) = 4.0 * w[a];
  }
  point.dN_dr = d.col(1) - d.col(0);
  point.dN_ds = d.col(2) - d.col(0);
  return point;
}

std::vector<FacePoint> quadraticRule() {
  std::vector<FacePoint> rule;
  const auto addThree = [&](double w, double weight) {
    for (int k = 0; k < 3; ++k) {
      Vec3 at = Vec3::Constant(w);
      at[k] = 1.0 - 2.0 * w;
      rule.push_back(quadraticPoint(at, weight));
    }
  };
  addThree(0.445948490915965, 0.223381589678011);
  addThree(0.091576213509771, 0.109951743655322);
  return rule;
}

}  // namespace

const std::vector<FacePoint>& faceRule(Eigen::Index num_nodes) {
  static const std::vector<FacePoint> kLinear{linearPoint()}, kQuadratic = quadraticRule();
  return num_nodes == 3 ? kLinear : kQuadratic;
}

}  // namespace palpate::fem
