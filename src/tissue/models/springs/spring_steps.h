// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "moving_region.h"
#include "spring_forces.h"
#include "spring_integrators.h"
#include "tissue/body/step_method.h"
#include "tissue/methods/explicit/explicit_contact.h"

namespace palpate::tissue {

/// Settings of explicit steps of springs.
struct SpringStepSettings {
  const SpringIntegrator* integrator;
  double step;    ///< Largest sub-step [s]; 0: 0.9 of the stable one in any configuration.
  double radius;  ///< Radius of MovingRegion [m]; infinity: all points move.
  double load_square = 0.0;  ///< Upper bound of squared frequencies of the body's loads [1/s^2].
};

/// Explicit steps of point masses, springs and dampers,
///
///   m a = -dW/dx - sum_springs l (v_ab . n) n - c m v + loads,   l = b k + the spring's own,
///
/// with stiffness damping b and mass damping c of the organ, in sub-steps of the integrator.
/// Touched points use symplectic Euler with implicit contact (ContactUpdate).
///
/// TissueStep: sweep_stages: number of sub-steps; still_points: fixed points, whose unbalanced
/// forces count as support forces. A cycle with values that are not finite, tissue passing through
/// a tool, or spurious energy is repeated with 2, 4 and 8 times the sub-steps (time_steps), then
/// fails. Interrupts are polled after each sub-step and end the cycle.
class SpringSteps final : public StepMethod {
 public:
  /// `springs`: of the body's elasticity.
  /// @throws std::invalid_argument, with the limit, for an unstable step, or where none is stable.
  SpringSteps(FemBody* body, const SpringForces* springs, const SpringStepSettings& settings);

  bool advance(double dt, TissueStep* out) override;
  void reportForces(TissueStep* out) override;
  double unbalancedForce() override;
  const Eigen::VectorXd& masses() const override { return masses_; }
  void restart() override;
  void stop() override {}
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

 private:
  double longestStep(double square) const;
  bool run(double dt, int steps, TissueStep* out);
  bool subStep(double h, double s, TissueStep* out);
  void accelerate();
  void clearRegionAtRest(const TissueStep& out);
  void addForces(Points* g) const;
  double energy(const Points& x, const Points& v, double* own);
  bool plausible();

  FemBody& body_;
  const SpringForces& forces_;
  SpringStepSettings settings_;
  Eigen::VectorXd masses_;
  double own_damping_;    // upper bound of damping rates by springs' own dampers [1/s]
  Points minus_weight_;   // 3 x n [N]
  bool loads_vary_;       // in addition to gravity
  double square_;         // upper bound of squared frequencies [1/s^2]
  double longest_ = 0.0;  // sub-step [s]
  ExplicitContact contact_;
  MovingRegion region_;
  Points g_;                      // minus all forces but contact, 3 x n [N]; valid at moving points
  Points way_, next_, held_way_;  // of a sub-step
  StateWriter touched_;           // contact state at the cycle's begin
  Points begin_x_, begin_v_, contact_g_;
  Eigen::VectorXd coefficients_;
  // Since tools began to touch: total and internal energy [J], and the tools' work [J].
  struct Account {
    double all = 0.0, own = 0.0, work = 0.0;
    bool open = false;
  };
  Account account_;
  double work_ = 0.0;  // in this cycle [J]
  bool touched_now_ = false, gained_ = false;
  // Energy [J] and forces at a point [N] with all springs stretched to twice their length.
  double all_springs_;
  Eigen::VectorXd strong_;
};

}  // namespace palpate::tissue
