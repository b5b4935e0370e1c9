// SPDX-License-Identifier: GPL-3.0-or-later
#include "tensors.h"

#include <Eigen/Geometry>

namespace palpate::tissue {
namespace {

struct Lame {
  double lambda, mu;
};

Lame lameOf(const material::Solid& solid) {
  const material::Moduli m = material::moduli(solid.law);
  return {m.kappa - 2.0 / 3.0 * m.mu, m.mu};
}

// Twice the area vectors of the faces opposite the corners, outward; their sum is zero.
Eigen::Matrix<double, 3, 4> areaVectors(const Points& X, const Eigen::Vector4i& tet) {
  constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  Eigen::Matrix<double, 3, 4> M;
  for (int k = 0; k < 4; ++k) {
    const Vec3 a = X.col(tet[kFaces[k][0]]), b = X.col(tet[kFaces[k][1]]),
               c = X.col(tet[kFaces[k][2]]);
    M.col(k) = (b - a).cross(c - a);
  }
  return M;
}

}  // namespace

Mat3 hookeStress(const material::Solid& solid, const Mat3& F) {
  const Lame lame = lameOf(solid);
  const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
  return lame.lambda * strain.trace() * Mat3::Identity() + 2.0 * lame.mu * strain;
}

void addTensors(const mesh::TetMesh& mesh, Eigen::Index t, double volume,
                const material::Solid& solid, fem::BlockMatrix* sums) {
  const Lame lame = lameOf(solid);
  const Eigen::Vector4i tet = mesh.tets.col(t);
  const Eigen::Matrix<double, 3, 4> M = areaVectors(mesh.points, tet);
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) {
      const Vec3 a = M.col(j), b = M.col(k);
      sums->block(sums->find(tet[j], tet[k])) +=
          (lame.lambda * a * b.transpose() + lame.mu * b * a.transpose() +
           lame.mu * a.dot(b) * Mat3::Identity()) /
          (36.0 * volume);
    }
  }
}

}  // namespace palpate::tissue
