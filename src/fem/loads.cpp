// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/loads.h"

#include <algorithm>

#include "palpate/material/tensor.h"

namespace palpate::fem {
namespace {

// (b - a) x (c - a): twice the area, along the outward normal.
Vec3 doubleArea(const Points& x, const Eigen::Vector3i& f) {
  const Vec3 a = x.col(f[0]);
  return (x.col(f[1]) - a).cross(x.col(f[2]) - a);
}

}  // namespace

Eigen::Matrix3Xi selectFaces(const Eigen::Matrix3Xi& surface, const std::vector<int>& nodes) {
  Eigen::Matrix3Xi faces(3, surface.cols());
  Eigen::Index count = 0;
  const auto selected = [&](int i) { return std::binary_search(nodes.begin(), nodes.end(), i); };
  for (Eigen::Index t = 0; t < surface.cols(); ++t) {
    if (selected(surface(0, t)) && selected(surface(1, t)) && selected(surface(2, t))) {
      faces.col(count++) = surface.col(t);
    }
  }
  faces.conservativeResize(3, count);
  return faces;
}

Points tractionForces(const Points& X, const Eigen::Matrix3Xi& faces, const Vec3& traction) {
  Points forces = Points::Zero(3, X.cols());
  for (Eigen::Index t = 0; t < faces.cols(); ++t) {
    const Vec3 share = doubleArea(X, faces.col(t)).norm() / 6.0 * traction;
    for (int a = 0; a < 3; ++a) forces.col(faces(a, t)) += share;
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
  for (Eigen::Index t = 0; t < faces_.cols(); ++t) {
    volume += (x.col(faces_(0, t)) - origin).dot(doubleArea(x, faces_.col(t))) / 6.0;
  }
  return factor_ * pressure_ * volume;
}

double FollowerPressure::addGradient(const Points& x, Points* g) const {
  for (Eigen::Index t = 0; t < faces_.cols(); ++t) {
    const Vec3 push = factor_ * pressure_ / 6.0 * doubleArea(x, faces_.col(t));
    for (int a = 0; a < 3; ++a) g->col(faces_(a, t)) += push;
  }
  return value(x);
}

void FollowerPressure::addHessian(const Points& x, Tangent tangent, BlockMatrix* K) const {
  if (tangent != Tangent::kExact) return;  // indefinite; left out where safety is asked for
  const double s = factor_ * pressure_ / 6.0;
  for (Eigen::Index t = 0; t < faces_.cols(); ++t) {
    const Eigen::Vector3i f = faces_.col(t);
    // d/dx_b of (b - a) x (c - a) is [v - u]x, u and v the next two corners.
    Mat3 derivative[3];
    for (int b = 0; b < 3; ++b) {
      const Vec3 opposite = x.col(f[(b + 2) % 3]) - x.col(f[(b + 1) % 3]);
      derivative[b] = s * material::crossMatrix(opposite);
    }
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        // Symmetric part of the block matrix whose (a, b) block is derivative[b].
        K->block(K->find(f[a], f[b])) += 0.5 * (derivative[b] + derivative[a].transpose());
      }
    }
  }
}

}  // namespace palpate::fem
