// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "unchanging_elasticity.h"

namespace palpate::tissue {

/// Base of models on tetrahedra other than finite elements: a law between the corners, and masses
/// lumped by volume.
class CellElasticity : public UnchangingElasticity {
 public:
  /// `mesh`: linear, rest configuration, world [m].
  /// @throws std::invalid_argument for quadratic, inverted or degenerate tetrahedra.
  CellElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition);

  fem::Stiffness makeMatrix() const override;
  double minJacobian(const Points& x) override;
  std::vector<fem::PointState> states(const Points& x,
                                      const std::vector<mesh::Location>& places) override;
  Eigen::VectorXd energyBySolid(const Points& x) override;
  double volume() const override { return volumes_.sum(); }
  mesh::LumpedMasses lumpedMasses() const override;

 protected:
  const mesh::TetMesh& mesh() const { return mesh_; }
  const fem::Composition& composition() const { return composition_; }
  /// Volumes of the tetrahedra at rest [m^3].
  const Eigen::VectorXd& volumes() const { return volumes_; }
  /// Deformation gradient of tetrahedron t.
  Mat3 deformation(const Points& x, Eigen::Index t) const;

 private:
  /// Cauchy stress of tetrahedron t, whose deformation gradient is F [Pa].
  virtual Mat3 cauchyStress(const Points& x, int t, const Mat3& F) = 0;
  /// Energy of tetrahedron t [J].
  virtual double energyOf(const Points& x, int t) = 0;

  mesh::TetMesh mesh_;
  fem::Composition composition_;
  Eigen::VectorXd volumes_;
  std::vector<Mat3> inverse_edges_;  // inverse of edges 01 02 03 at rest
};

}  // namespace palpate::tissue
