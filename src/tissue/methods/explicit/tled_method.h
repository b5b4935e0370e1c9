// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "critical_step.h"
#include "explicit_contact.h"
#include "tissue/body/step_method.h"

namespace palpate::tissue {

/// Explicit total Lagrangian dynamics [Miller, Joldes, Lance, Wittek 2007]: central differences
/// with lumped masses m and damping a by mass, in sub-steps h shorter than the critical one,
///
///   (1 + a h/2) u_{n+1/2} = (1 - a h/2) u_{n-1/2} + h/m (f(x_n) + c(x_{n+1})),
///   x_{n+1} = x_n + h u_{n+1/2},
///
/// f the elastic forces and gravity, c the contact forces, implicit by ContactUpdate, so that the
/// penalty does not bound h. The tools move by a fraction of their path in each sub-step. Viscous
/// memory is updated in each sub-step.
///
/// TissueStep: sweep_stages: number of sub-steps; time_steps: refinement over the stable number;
/// `residual`: of the last ContactUpdate; inertia_force: from the change of velocities. A cycle
/// with spurious energy, or with tissue passing through a tool, is repeated with twice the
/// sub-steps, then fails. It fails at once with more than 2000 sub-steps, with 20 times those at
/// rest due to compressed elements, with slow contact in most of them, or overrun: a tool ends deep
/// in tissue, or touched elements are inverted. Positions set with inverted elements count as
/// overrun.
class TledMethod final : public StepMethod {
 public:
  explicit TledMethod(FemBody* body);

  bool advance(double dt, TissueStep* out) override;
  /// Whether tissue is overrun at the end of the last cycle, which was cut, or by set positions.
  bool overran() const { return overran_; }
  void reportForces(TissueStep* out) override;
  double unbalancedForce() override;
  const Eigen::VectorXd& masses() const override { return masses_; }
  void restart() override;
  void stop() override;
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

 private:
  // Energies since a cycle's begin [J]; over several cut cycles until they make up a whole one.
  struct EnergyBudget {
    double kinetic = 0.0, potential = 0.0;  // at the begin
    double least_potential = 0.0;           // least at a cycle's end
    double work = 0.0;                      // sum of absolute contact work
    double cycles = 1.0;                    // number of cycles, < 1 while open
    bool isOpen() const { return cycles < 1.0; }
  };
  // Sub-steps of a cycle.
  struct SubSteps {
    double h;  // [s]
    int steps;
    int taken = 0;
    bool touched = false, late = false;  // late: cut at a deadline after `taken`
    double least_jacobian = 1.0;         // where touched, least det F
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
  double potential_;  // energy of both [J]
  Points u_, next_;   // velocities at half steps; next positions
  Points contact_g_;  // of the contact, at the last cycle's end
  Points inertia_;    // inertial and damping forces at the cycle's end
  Points held_way_, held_velocity_, held_before_;  // of this sub-step and the one before
  Points x_begin_, v_begin_, g_begin_;
  Eigen::VectorXd coefficients_;
  EnergyBudget budget_;        // extended by the next cycle while it is open
  double work_ = 0.0;          // present sum of EnergyBudget::work [J]
  bool energy_grew_ = false;   // spurious energy
  bool tunnelled_ = false;     // tissue would pass through a tool
  bool contact_slow_ = false;  // contact takes many iterations in most sub-steps
  bool overran_ = false;       // deep in a tool, or inverted
  int refinement_ = 1;         // factor on the stable number of sub-steps
};

}  // namespace palpate::tissue
