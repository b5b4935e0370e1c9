// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/fem/energy_term.h"

namespace palpate::fem {

// Faces are those of mesh::boundaryFaces(): 3 x k, or 6 x k of quadratic tetrahedra.

/// Faces of `surface` whose three corners are all in `nodes` (ascending).
Eigen::MatrixXi selectFaces(const Eigen::MatrixXi& surface, const std::vector<int>& nodes);

/// Nodal forces, 3 x n [N], of a traction [Pa] on `faces` at X, by the shape functions of the
/// faces.
Points tractionForces(const Points& X, const Eigen::MatrixXi& faces, const Vec3& traction);

/// Forces independent of the deformation: energy -f . x.
class DeadLoad final : public EnergyTerm {
 public:
  explicit DeadLoad(Points forces) : forces_(std::move(forces)) {}

  void setForces(const Points& forces) { forces_ = forces; }
  /// Multiplies the forces by `factor`.
  void setFactor(double factor) { factor_ = factor; }
  Points forces() const { return factor_ * forces_; }

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points&, Tangent, Stiffness*) const override {}

 private:
  Points forces_;
  double factor_ = 1.0;
};

/// Pressure [Pa] that stays normal to the deformed faces; positive pushes inward. The force on node
/// a of a face x(r, s) is minus the integral of p N_a dx/dr x dx/ds [Bonet, Wood 2008, sec. 8.5.2
/// for the linearisation]. The value is p times the volume under the faces, whose gradient is the
/// force on a closed surface or one with a held rim; the stiffness is its symmetric part.
class FollowerPressure final : public EnergyTerm {
 public:
  FollowerPressure(Eigen::MatrixXi faces, double pressure)
      : faces_(std::move(faces)), pressure_(pressure) {}

  void setFactor(double factor) { factor_ = factor; }

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, Tangent tangent, Stiffness* K) const override;
  bool conservative() const override { return false; }

 private:
  Eigen::MatrixXi faces_;
  double pressure_;
  double factor_ = 1.0;
};

}  // namespace palpate::fem
