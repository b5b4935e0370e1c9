// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/triangle_distance.h"

#include <cmath>

namespace palpate::contact {
namespace {

TrianglePoint atCorner(const Vec3& corner, int k) {
  return {corner, Vec3::Unit(k), Feature::kVertex, k};
}

// `corner`: where the edge begins; it is a part `s` of the way to the next one.
TrianglePoint onEdge(const Vec3& point, int corner, double s) {
  Vec3 weights = Vec3::Zero();
  weights[corner] = 1.0 - s;
  weights[(corner + 1) % 3] = s;
  return {point, weights, Feature::kEdge, corner};
}

}  // namespace

// The seven Voronoi regions of its corners, edges and face (Ericson, Real-Time Collision
// Detection, 2005, section 5.1.5).
TrianglePoint nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double ab_ap = ab.dot(ap), ac_ap = ac.dot(ap);
  if (ab_ap <= 0.0 && ac_ap <= 0.0) return atCorner(a, 0);
  const double ab_bp = ab.dot(bp), ac_bp = ac.dot(bp);
  if (ab_bp >= 0.0 && ac_bp <= ab_bp) return atCorner(b, 1);
  const double ab_cp = ab.dot(cp), ac_cp = ac.dot(cp);
  if (ac_cp >= 0.0 && ab_cp <= ac_cp) return atCorner(c, 2);

  // Barycentric coordinates of the projection, times twice the area squared.
  const double wc = ab_ap * ac_bp - ab_bp * ac_ap;
  if (wc <= 0.0 && ab_ap >= 0.0 && ab_bp <= 0.0) {
    const double s = ab_ap / (ab_ap - ab_bp);
    return onEdge(a + s * ab, 0, s);
  }
  const double wb = ab_cp * ac_ap - ab_ap * ac_cp;
  if (wb <= 0.0 && ac_ap >= 0.0 && ac_cp <= 0.0) {
    const double s = ac_ap / (ac_ap - ac_cp);
    return onEdge(a + s * ac, 2, 1.0 - s);
  }
  const double wa = ab_bp * ac_cp - ab_cp * ac_bp;
  const double along_b = ac_bp - ab_bp, along_c = ab_cp - ac_cp;
  if (wa <= 0.0 && along_b >= 0.0 && along_c >= 0.0) {
    const double s = along_b / (along_b + along_c);
    return onEdge(b + s * (c - b), 1, s);
  }
  const double sum = wa + wb + wc;
  return {a + (wb / sum) * ab + (wc / sum) * ac, Vec3(wa, wb, wc) / sum, Feature::kFace, 0};
}

// The distance D is sqrt(2 Q) of Q = min over s of |p - sum_k w_k(s) x_k|^2 / 2, s being one
// parameter along an edge, two within the face. With r = D m, tangents e_i = d(point)/ds_i and the
// metric G_ij = e_i . e_j, the implicit function theorem gives, by corners k and l,
//
//   Q_kl = w_k w_l (1 - e_i G^-1_ij e_j^T) + D (w_k,i m w_l e_j^T + w_k e_i w_l,j m^T) G^-1_ij
//          - D^2 w_k,i w_l,j G^-1_ij m m^T,
//
// and D_kl = (Q_kl - w_k w_l m m^T) / D, where within the face the first part and m m^T cancel.
Eigen::Matrix<double, 9, 9> triangleDistanceHessian(const Mat3& x, const TrianglePoint& near,
                                                    const Vec3& m, double distance) {
  Eigen::Matrix<double, 9, 9> H = Eigen::Matrix<double, 9, 9>::Zero();
  const int edges = near.feature == Feature::kFace ? 2 : near.feature == Feature::kEdge ? 1 : 0;
  if (edges < 2 && !(std::abs(distance) > 1e-9)) return H;

  // Columns: tangents, and the weights' derivatives.
  Mat3 e = Mat3::Zero(), dw = Mat3::Zero();
  for (int i = 0; i < edges; ++i) {
    const int from = edges == 2 ? 0 : near.corner, to = edges == 2 ? i + 1 : (near.corner + 1) % 3;
    e.col(i) = x.col(to) - x.col(from);
    dw(from, i) = -1.0;
    dw(to, i) = 1.0;
  }
  Mat3 inverse = Mat3::Zero();  // of the metric
  if (edges == 1) inverse(0, 0) = 1.0 / e.col(0).squaredNorm();
  if (edges == 2) {
    const Eigen::Matrix2d metric = e.leftCols<2>().transpose() * e.leftCols<2>();
    inverse.topLeftCorner<2, 2>() = metric.inverse();
  }
  Mat3 across = Mat3::Zero();
  if (edges < 2) {
    across = (Mat3::Identity() - e * inverse * e.transpose() - m * m.transpose()) / distance;
  }
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {
      const Vec3 ek = e * inverse * dw.row(k).transpose(), el = e * inverse * dw.row(l).transpose();
      const double metric = dw.row(k) * inverse * dw.row(l).transpose();
      H.block<3, 3>(3 * k, 3 * l) =
          near.weights[k] * near.weights[l] * across + near.weights[l] * m * ek.transpose() +
          near.weights[k] * el * m.transpose() - distance * metric * m * m.transpose();
    }
  }
  return H;
}

}  // namespace palpate::contact
