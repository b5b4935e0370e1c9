// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/loads.h"

#include <algorithm>

#include "face_rule.h"
#include "palpate/material/tensor.h"

namespace palpate::fem {

Eigen::MatrixXi selectFaces(const Eigen::MatrixXi& surface, const std::vector<int>& nodes) {
  Eigen::MatrixXi faces(surface.rows(), surface.cols());
  Eigen::Index count = 0;
  const auto selected = [&](int i) { return std::binary_search(nodes.begin(), nodes.end(), i); };
  for (Eigen::Index t = 0; t < surface.cols(); ++t) {
    if (selected(surface(0, t)) && selected(surface(1, t)) && selected(surface(2, t))) {
      faces.col(count++) = surface.col(t);
    }
  }
  faces.conservativeResize(Eigen::NoChange, count);
  return faces;
}

Points tractionForces(const Points& X, const Eigen::MatrixXi& faces, const Vec3& traction) {
  Points forces = Points::Zero(3, X.cols());
  for (const FacePoint& q : faceRule(faces.rows())) {
    for (Eigen::Index t = 0; t < faces.cols(); ++t) {
      const Vec3 force = q.weight * q.areaVector(X, faces.col(t)).norm() * traction;
      for (Eigen::Index a = 0; a < faces.rows(); ++a) forces.col(faces(a, t)) += q.N[a] * force;
    }
  }
  return forces;
}

double DeadLoad::value(const Points& x) const { return -factor_ * forces_.cwiseProduct(x).sum(); }

double DeadLoad::addGradient(const Points& x, Points* g) const {
  *g -= factor_ * forces_;
  return value(x);
}

double FollowerPressure::value(const Points& x) const {
  if (faces_.cols() == 0) return 0.0;
  const Vec3 origin = x.col(faces_(0, 0));  // near the faces, against cancellation
  double volume = 0.0;
  for (const FacePoint& q : faceRule(faces_.rows())) {
    for (Eigen::Index t = 0; t < faces_.cols(); ++t) {
      const Vec3 area = q.weight * q.areaVector(x, faces_.col(t));
      volume += (q.interpolate(x, faces_.col(t), q.N) - origin).dot(area) / 3.0;
    }
  }
  return factor_ * pressure_ * volume;
}

double FollowerPressure::addGradient(const Points& x, Points* g) const {
  for (const FacePoint& q : faceRule(faces_.rows())) {
    for (Eigen::Index t = 0; t < faces_.cols(); ++t) {
      const Vec3 push = factor_ * pressure_ * q.weight * q.areaVector(x, faces_.col(t));
      for (Eigen::Index a = 0; a < faces_.rows(); ++a) g->col(faces_(a, t)) += q.N[a] * push;
    }
  }
  return value(x);
}

void FollowerPressure::addHessian(const Points& x, Tangent tangent, Stiffness* K) const {
  if (tangent != Tangent::kExact) return;  // indefinite; left out where safety is asked for
  Eigen::MatrixXd H(3 * faces_.rows(), 3 * faces_.rows());
  for (const FacePoint& q : faceRule(faces_.rows())) {
    for (Eigen::Index t = 0; t < faces_.cols(); ++t) {
      const auto f = faces_.col(t);
      const double s = factor_ * pressure_ * q.weight;
      const Mat3 r = s * material::crossMatrix(q.interpolate(x, f, q.dN_dr));
      const Mat3 s_cross = s * material::crossMatrix(q.interpolate(x, f, q.dN_ds));
      for (Eigen::Index a = 0; a < faces_.rows(); ++a) {
        for (Eigen::Index b = 0; b < faces_.rows(); ++b) {
          // Symmetric part of the matrix whose (a, b) block is N_a d(dx/dr x dx/ds)/dx_b.
          const Mat3 ab = q.N[a] * (q.dN_ds[b] * r - q.dN_dr[b] * s_cross);
          const Mat3 ba = q.N[b] * (q.dN_ds[a] * r - q.dN_dr[a] * s_cross);
          H.block<3, 3>(3 * a, 3 * b) = 0.5 * (ab + ba.transpose());
        }
      }
      K->add(f, H);
    }
  }
}

}  // namespace palpate::fem
