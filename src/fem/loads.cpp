// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/loads.h"

#include <algorithm>

#include "face_rule.h"
#include "face_volume.h"

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
  return factor_ * pressure_ * volumeUnder(x, faces_);
}

double FollowerPressure::addGradient(const Points& x, Points* g) const {
  addVolumeGradient(x, faces_, factor_ * pressure_, g);
  return value(x);
}

void FollowerPressure::addHessian(const Points& x, Tangent tangent, Stiffness* K) const {
  if (tangent != Tangent::kExact) return;  // indefinite; only the exact tangent contains it
  addVolumeHessian(x, faces_, factor_ * pressure_, K);
}

}  // namespace palpate::fem
