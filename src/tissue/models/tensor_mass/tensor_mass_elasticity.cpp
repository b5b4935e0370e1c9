// SPDX-License-Identifier: GPL-3.0-or-later
#include "tensor_mass_elasticity.h"

#include "tensors.h"

namespace palpate::tissue {

TensorMassElasticity::TensorMassElasticity(const mesh::TetMesh& mesh,
                                           const fem::Composition& composition)
    : CellElasticity(mesh, composition), tensors_(makeMatrix().blocks()) {
  for (int t = 0; t < static_cast<int>(mesh.numTets()); ++t) {
    addTensors(mesh, t, volumes()[t], composition.solid(t), &tensors_);
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
  return hookeStress(composition().solid(t), F);
}

double TensorMassElasticity::energyOf(const Points& x, int t) {
  const Mat3 F = deformation(x, t);
  const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
  return 0.5 * volumes()[t] * hookeStress(composition().solid(t), F).cwiseProduct(strain).sum();
}

}  // namespace palpate::tissue
