// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "element_scatter.h"
#include "palpate/fem/elasticity.h"

namespace palpate::fem {

/// Linear tetrahedra with constant deformation gradient F = sum_a x_a (x) g_a, g_a = grad N_a at
/// rest [Bonet, Wood 2008, sec. 9.2]. Locks for nearly incompressible laws.
class Tet4 final : public Elasticity {
 public:
  Tet4(const TetMesh& mesh, const material::Material& material, ThreadPool* pool);

  int numNodes() const override { return static_cast<int>(nodal_volumes_.size()); }
  BlockMatrix makeMatrix() const override { return scatter_.pattern(); }
  double energy(const Points& x) override;
  double gradient(const Points& x, Points* g) override;
  void hessian(const Points& x, Tangent tangent, BlockMatrix* K) override;
  double minJacobian(const Points& x) const override;
  Mat3 deformationGradient(const Points& x, int e) const override;
  const Eigen::VectorXd& nodalVolumes() const override { return nodal_volumes_; }

 private:
  using Gradients = Eigen::Matrix<double, 3, 4>;  // g_a, [1/m]

  Eigen::Matrix4Xi tets_;
  std::vector<Gradients> gradients_;  // one an element
  std::vector<double> volumes_;       // at rest [m^3]
  Eigen::VectorXd nodal_volumes_;
  material::Material material_;
  ThreadPool* pool_;
  ElementScatter scatter_;

  std::vector<double> energies_;  // scratch, one an element
  Eigen::Matrix<double, 12, Eigen::Dynamic> forces_;
  Eigen::Matrix<double, 90, Eigen::Dynamic> blocks_;
};

}  // namespace palpate::fem
