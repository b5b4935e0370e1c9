// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "moving_region.h"
#include "spring_forces.h"
#include "spring_integrators.h"
#include "tissue/fem/explicit_contact.h"
#include "tissue/fem/step_method.h"

namespace palpate::tissue {

/// How the springs of a body go on in explicit steps.
struct SpringStepSettings {
  const SpringIntegrator* integrator;
  double step;    ///< Longest sub-step [s]; 0: nine tenths of what is stable in any shape.
  double radius;  ///< Of MovingRegion [m]; infinity: all moves.
  double load_square = 0.0;  ///< Bound of frequencies by the body's loads, squared [1/s^2].
};

/// Explicit steps of point masses, springs and dampers,
///
///   m a = -dW/dx - sum_springs l (v_ab . n) n - c m v + loads,   l = b k + the spring's own,
///
/// b the organ's damping by stiffness, c that by mass, in sub-steps of the integrator. Touched
/// points go as symplectic Euler has them, with the contact's forces of the end (ContactUpdate).
///
/// TissueStep: sweep_stages is the number of sub-steps, still_points how many points were left
/// where they are, whose unbalanced forces count as those of supports. A cycle that would end
/// with numbers that are not finite, carry tissue through a tool, or gain more energy than tools
/// give, is repeated with 2, 4 and 8 times the sub-steps (time_steps), then fails. An interrupt is
/// asked after each sub-step; the cycle then ends there, late.
class SpringSteps final : public StepMethod {
 public:
  /// `springs`: those of the body's elasticity. @throws std::invalid_argument, with the limit, for
  /// a step that is longer than the stable one at rest, or where there is none.
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
  double own_damping_;    // bound of the rate at which springs' own dampers damp [1/s]
  Points minus_weight_;   // 3 x n [N]
  bool loads_vary_;       // beside gravity
  double square_;         // bound of all frequencies' [1/s^2]
  double longest_ = 0.0;  // sub-step [s]
  ExplicitContact contact_;
  MovingRegion region_;
  Points g_;  // minus all forces but contact, 3 x n [N]; where nothing moves, of no use
  Points way_, next_, held_way_;  // of a sub-step
  StateWriter touched_;           // where the cycle began, and
  Points begin_x_, begin_v_, contact_g_;
  Eigen::VectorXd coefficients_;
  // Since tools began to touch: energies [J] of all and of what is its own, and the tools' work.
  struct Account {
    double all = 0.0, own = 0.0, work = 0.0;
    bool open = false;
  };
  Account account_;
  double work_ = 0.0;  // in this cycle [J]
  bool touched_now_ = false, gained_ = false;
  // If each spring were stretched to twice its length: energy [J], and forces at a point [N].
  double all_springs_;
  Eigen::VectorXd strong_;
};

}  // namespace palpate::tissue
