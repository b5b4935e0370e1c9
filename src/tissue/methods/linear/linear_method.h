// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface_compliance.h"
#include "tissue/body/step_method.h"
#include "tissue/touch/compliant_contact.h"

namespace palpate::tissue {

/// Linear elastostatics with a precomputed factorisation [Bro-Nielsen, Cotin 1996; James, Pai
/// 1999]. A cycle solves for contact forces on the surface compliance, then for all displacements
/// by one back-substitution. Gravity is superposed. Quasi-static: no inertia, no damping;
/// velocities are differences over the cycle.
///
/// The stiffness is that at rest: forces are linear, volume is kept to first order only, and large
/// rotations are wrong.
class LinearMethod final : public StepMethod {
 public:
  /// @throws std::invalid_argument as SurfaceCompliance.
  explicit LinearMethod(FemBody* body);

  bool advance(double dt, TissueStep* out) override;
  void reportForces(TissueStep* out) override;
  double unbalancedForce() override { return residual_; }
  const Eigen::VectorXd& masses() const override { return body_.elasticity->masses(); }
  std::optional<double> elasticEnergy() const override { return energy_; }
  void moveToEquilibrium(Points* x) override;
  void restart() override;
  void stop() override {}
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

 private:
  solver::NewtonReport solveStage(bool on_the_way, TissueStep* out);
  void moveHeld(double s);
  void addAnchorForces(Points* g) const;
  double elasticEnergy(const Points& u, const Points& g) const;
  void balance();

  FemBody& body_;
  SurfaceCompliance compliance_;
  CompliantContact contact_;
  Points loads_;    // gravity and loads at rest, 3 x n [N]
  Points u_loads_;  // displacements under loads_ [m]
  Points u0_;       // displacements without contact: u_loads_ and prescribed motion [m]
  Points force_;    // of contact on the nodes [N]
  Points x_begin_, force_begin_, u_, g_;
  double residual_ = 0.0, energy_ = 0.0;
};

}  // namespace palpate::tissue
