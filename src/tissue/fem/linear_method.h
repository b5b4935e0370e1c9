// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "step_method.h"
#include "surface_compliance.h"
#include "tissue/touch/compliant_contact.h"

namespace palpate::tissue {

/// Linear elastostatics with everything but contact solved beforehand [Bro-Nielsen, Cotin 1996;
/// James, Pai 1999]: a cycle solves for the contact forces on the surface's compliance, then for
/// all displacements by one back-substitution. Gravity is superposed. Quasi-static: no inertia, no
/// damping; velocities are differences over the cycle.
///
/// The stiffness is that of the element and law at rest, so forces grow linearly with the load,
/// volume is kept to first order only, and a part that turns is deformed by it: large rotations are
/// wrong.
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
  Points u_loads_;  // under them
  Points u0_;       // without contact: u_loads_, and what held nodes and anchors take along
  Points force_;    // of contact on the nodes [N]
  Points x_begin_, force_begin_, u_, g_;
  double residual_ = 0.0, energy_ = 0.0;
};

}  // namespace palpate::tissue
