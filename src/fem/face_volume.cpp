// SPDX-License-Identifier: GPL-3.0-or-later
#include "face_volume.h"

#include "face_rule.h"
#include "palpate/material/tensor.h"

namespace palpate::fem {

double volumeUnder(const Points& x, const Eigen::MatrixXi& faces) {
  if (faces.cols() == 0) return 0.0;
  const Vec3 origin = x.col(faces(0, 0));  // near the faces, to limit cancellation
  double volume = 0.0;
  for (const FacePoint& q : faceRule(faces.rows())) {
    for (Eigen::Index t = 0; t < faces.cols(); ++t) {
      const Vec3 area = q.weight * q.areaVector(x, faces.col(t));
      volume += (q.interpolate(x, faces.col(t), q.N) - origin).dot(area) / 3.0;
    }
  }
  return volume;
}

void addVolumeGradient(const Points& x, const Eigen::MatrixXi& faces, double s, Points* g) {
  for (const FacePoint& q : faceRule(faces.rows())) {
    for (Eigen::Index t = 0; t < faces.cols(); ++t) {
      const Vec3 push = s * q.weight * q.areaVector(x, faces.col(t));
      for (Eigen::Index a = 0; a < faces.rows(); ++a) g->col(faces(a, t)) += q.N[a] * push;
    }
  }
}

void addVolumeHessian(const Points& x, const Eigen::MatrixXi& faces, double s, Stiffness* K) {
  for (const FacePoint& q : faceRule(faces.rows())) {
    for (Eigen::Index t = 0; t < faces.cols(); ++t) {
      const auto f = faces.col(t);
      const double weight = s * q.weight;
      const Mat3 dr = weight * material::crossMatrix(q.interpolate(x, f, q.dN_dr));
      const Mat3 ds = weight * material::crossMatrix(q.interpolate(x, f, q.dN_ds));
      for (Eigen::Index a = 0; a < faces.rows(); ++a) {
        for (Eigen::Index b = 0; b < faces.rows(); ++b) {
          // Symmetric part of the matrix whose (a, b) block is N_a d(dx/dr x dx/ds)/dx_b.
          const Mat3 ab = q.N[a] * (q.dN_ds[b] * dr - q.dN_dr[b] * ds);
          const Mat3 ba = q.N[b] * (q.dN_ds[a] * dr - q.dN_dr[a] * ds);
          K->add(f[a], f[b], 0.5 * (ab + ba.transpose()));
        }
      }
    }
  }
}

}  // namespace palpate::fem
