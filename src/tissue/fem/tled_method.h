// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "critical_step.h"
#include "explicit_contact.h"
#include "step_method.h"

namespace palpate::tissue {

/// Explicit total Lagrangian dynamics [Miller, Joldes, Lance, Wittek 2007]: central differences
/// with lumped masses m and damping a by mass, in sub-steps h shorter than the critical one,
///
///   (1 + a h/2) u_{n+1/2} = (1 - a h/2) u_{n-1/2} + h/m (f(x_n) + c(x_{n+1})),
///   x_{n+1} = x_n + h u_{n+1/2},
///
/// f the elastic forces and gravity, c the contact's, taken implicitly (ContactUpdate), so that the
/// penalty does not bound h. The tools go on by a part of their way in each sub-step. In a viscous
/// body each sub-step is one of its memory.
///
/// TissueStep: sweep_stages is the number of sub-steps, time_steps by how much more they are than
/// stability asks for; `residual` what the last ContactUpdate left
/// unbalanced, everything else obeys its equation to rounding; inertia_force is that of the change
/// of velocities. A cycle that gains energy from nowhere or carries tissue through a tool is
/// repeated with twice the sub-steps, then fails; so does, at once, one in which elements are
/// squeezed so that it would take 20 times the sub-steps of rest, or that takes more than 2000, one
/// in which contact takes many iterations in most of them, and one in which a tool overran tissue:
/// it ends deep in it, or with touched elements inverted, which would stay on the tool or be
/// thrown. What is placed with elements inverted is overrun as well: it would be thrown by all
/// their energy.
class TledMethod final : public StepMethod {
 public:
  explicit TledMethod(FemBody* body);

  bool advance(double dt, TissueStep* out) override;
  /// Whether tissue is overrun where the last cycle ended, which was cut, or where it was placed.
  bool overran() const { return overran_; }
  void reportForces(TissueStep* out) override;
  double unbalancedForce() override;
  const Eigen::VectorXd& masses() const override { return masses_; }
  void restart() override;
  void stop() override;
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

 private:
  // Of energy [J], since a cycle began; of cycles that are cut, over as many as make up a whole
  // one.
  struct EnergyBudget {
    double kinetic = 0.0, potential = 0.0;  // as it began
    double least_potential = 0.0;           // at the ends of its cycles
    double work = 0.0;                      // sum of the moduli of the contact's
    double cycles = 1.0;                    // that it is of
    bool isOpen() const { return cycles < 1.0; }
  };
  // The sub-steps of a cycle.
  struct SubSteps {
    double h;  // [s]
    int steps;
    int taken = 0;
    bool touched = false, late = false;  // late: cut after those that are taken
    double least_jacobian = 1.0;         // where touched
  };

  int subSteps(double dt, TissueStep* out);
  bool run(double dt, int steps, TissueStep* out);
  bool runSubSteps(SubSteps* sub_steps, TissueStep* out);
  bool finishCycle(SubSteps* sub_steps, TissueStep* out);
  void subStep(double h, double s, TissueStep* out);
  void moveHeld(double h, double s);
  void addHeldInertia(double h);
  bool applyContact(double h, double s);
  void forces(double h);
  bool plausible(const EnergyBudget& since) const;
  double kineticEnergy() const;

  FemBody& body_;
  Eigen::VectorXd masses_;
  Points inverse_masses_;  // 1/m where free, else 0; 3 x n
  CriticalStep critical_;
  ExplicitContact contact_;

  Points g_;          // gradient of elasticity and gravity at x, 3 x n [N]
  double potential_;  // their energy [J]
  Points u_, next_;   // velocities amid steps; positions of the next one
  Points contact_g_;  // of the contact, at the last cycle's end
  Points inertia_;    // inertial and damping forces at the cycle's end
  Points held_way_, held_velocity_, held_before_;  // of a sub-step and the one before
  Points x_begin_, v_begin_, g_begin_;
  Eigen::VectorXd coefficients_;
  EnergyBudget budget_;        // to which the next cycle is added while it is open
  double work_ = 0.0;          // of the budget, up to now [J]
  bool energy_grew_ = false;   // energy that nothing brought
  bool tunnelled_ = false;     // tissue would have gone through a tool
  bool contact_slow_ = false;  // contact takes many iterations in most sub-steps
  bool overran_ = false;       // a tool left tissue deep in it, or inverted
  int refinement_ = 1;         // times as many sub-steps as the critical one needs
};

}  // namespace palpate::tissue
