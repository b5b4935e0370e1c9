// SPDX-License-Identifier: GPL-3.0-or-later
#include "tensor_mass_elasticity.h"

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

// Hooke's law.
Mat3 stressOf(const Lame& lame, const Mat3& F) {
  const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
  return lame.lambda * strain.trace() * Mat3::Identity() + 2.0 * lame.mu * strain;
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

TensorMassElasticity::TensorMassElasticity(const mesh::TetMesh& mesh,
                                           const fem::Composition& composition)
    : CellElasticity(mesh, composition), tensors_(makeMatrix().blocks()) {
  for (int t = 0; t < static_cast<int>(mesh.numTets()); ++t) {
    const Lame lame = lameOf(composition.solid(t));
    const Eigen::Vector4i tet = mesh.tets.col(t);
    const Eigen::Matrix<double, 3, 4> M = areaVectors(mesh.points, tet);
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        const Vec3 a = M.col(j), b = M.col(k);
        tensors_.block(tensors_.find(tet[j], tet[k])) +=
            (lame.lambda * a * b.transpose() + lame.mu * b * a.transpose() +
             lame.mu * a.dot(b) * Mat3::Identity()) /
            (36.0 * volumes()[t]);
      }
    }
  }
}

double TensorMassElasticity::energy(const Points& x) { return gradient(x, &f_); }

double TensorMassElasticity::gradient(const Points& x, Points* g) {
  u_ = x - mesh().points;
  tensors_.multiply(u_, g);
  return 0.5 * g->cwiseProduct(u_).sum();
}

void TensorMassElasticity::hessian(const Points&, fem::Tangent, fem::Stiffness* K) {
  K->setZero();
  for (int slot = 0; slot < tensors_.numBlocks(); ++slot) {
    K->blocks().block(slot) = tensors_.block(slot);
  }
}

Mat3 TensorMassElasticity::cauchyStress(const Points&, int t, const Mat3& F) {
  return stressOf(lameOf(composition().solid(t)), F);
}

double TensorMassElasticity::energyOf(const Points& x, int t) {
  const Mat3 F = deformation(x, t);
  const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
  return 0.5 * volumes()[t] *
         stressOf(lameOf(composition().solid(t)), F).cwiseProduct(strain).sum();
}

}  // namespace palpate::tissue
