// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "tissue/models/cells/unchanging_elasticity.h"
#include "tissue/models/springs/spring_forces.h"

namespace palpate::tissue {

/// Elasticity of springs between the points of a sheet. Triangles provide masses and det F, the
/// ratio of their area to that at rest.
class SheetElasticity final : public UnchangingElasticity {
 public:
  /// `thickness` [m], for the volume alone. @throws std::invalid_argument as SpringForces, and for
  /// a triangle without an area.
  SheetElasticity(const springs::SpringNetwork& network, const Eigen::Matrix3Xi& triangles,
                  double thickness);

  const SpringForces& forces() const { return forces_; }

  fem::Stiffness makeMatrix() const override { return forces_.makeMatrix(); }
  double energy(const Points& x) override { return forces_.energy(x); }
  double gradient(const Points& x, Points* g) override { return forces_.gradient(x, g); }
  void hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) override {
    forces_.hessian(x, tangent, K);
  }
  double minJacobian(const Points& x) override;
  /// @throws std::invalid_argument always: a sheet has no tetrahedra.
  std::vector<fem::PointState> states(const Points& x,
                                      const std::vector<mesh::Location>& places) override;
  Eigen::VectorXd energyBySolid(const Points& x) override;
  double volume() const override { return volume_; }
  mesh::LumpedMasses lumpedMasses() const override;

 private:
  SpringForces forces_;
  Eigen::Matrix3Xi triangles_;
  Eigen::VectorXd areas_;  // areas of the triangles at rest [m^2]
  double volume_;
};

}  // namespace palpate::tissue
