// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "palpate/base/phase_times.h"
#include "palpate/base/state_bytes.h"
#include "palpate/solver/interrupt.h"
#include "palpate/solver/potential.h"
#include "palpate/solver/status.h"
#include "palpate/solver/step_settings.h"

namespace palpate::solver {

struct NewtonSettings {
  double tolerance = 0.0;  ///< Absolute [N], on the norm of the free gradient.
  int max_iterations = StepSettings().max_newton_iterations;
  /// Relative, of the linear solves; tighter for the last.
  double linear_tolerance = StepSettings().linear_tolerance;
  /// Asked after every iteration and in linear solves; null: nobody is.
  const Interrupt* interrupt = nullptr;
  /// So many iterations are done before it is asked: 1, or 0 where x is a step ahead already.
  int least_iterations = 1;
  /// So often their steps are halved before it is asked: what is shorter moves little.
  int least_halvings = 8;

  bool interrupted() const { return isInterrupted(interrupt); }
};

struct NewtonReport {
  SolveStatus status = SolveStatus::kConverged;
  int iterations = 0;  ///< Steps taken.
  int halvings = 0;    ///< Of the steps, in line searches.
  int linear_iterations = 0;
  int projections = 0;       ///< Linear systems that had to be made positive definite.
  int kept_stiffnesses = 0;  ///< Elastic stiffnesses that were not assembled again.
  double residual = 0.0;     ///< Norm of the free gradient at the end [N].
  PhaseTimes phases;
};

class LinearSolver;

/// Finds minima of potentials of one body, one after another. Keeps its scratch memory, and what it
/// learnt, between calls.
class Minimizer {
 public:
  virtual ~Minimizer() = default;

  /// Improves x, 3 x n, whose held components stay. x is never worse than it was and always finite.
  virtual NewtonReport minimize(const Potential& potential, const NewtonSettings& settings,
                                Points* x) = 0;
  /// How many of its iterations stand for one of `max_iterations`.
  virtual int iterationsForOne() const { return 1; }
  /// What a factor takes that a solve waits for, which nothing interrupts [s], by the unit costs of
  /// unit_costs.h; 0: it waits for none, or knows no better.
  virtual double factorSeconds() const { return 0.0; }
  /// Moves the held components by `move` (3 x n, zero where free) and the free ones as the tangent
  /// at x says, a good first guess for the next load step. x is untouched if the solve fails.
  virtual SolveStatus predict(const Potential& potential, const Points& move, Points* x) = 0;

  /// The step d, 3 x n, of the free components that the tangent at x says if the force `push`, 3 x
  /// n [N], is added: A d = push - g. Its cost goes into `report`. False: there is none.
  virtual bool tangentStep(const Potential& /*potential*/, const Points& /*x*/,
                           const Points& /*push*/, double /*linear_tolerance*/, Points* /*d*/,
                           NewtonReport* /*report*/) {
    return false;
  }

  /// All components of the gradient where the last minimize() ended; on held ones it is the force
  /// that the support exerts on the body.
  virtual const Points& gradient() const = 0;
  /// Norm of the force that rounding alone makes at x, with the last matrix assembled [N]: no
  /// residual gets below it.
  virtual double roundoffForce(const Points& x) const = 0;

  /// By which linear systems are solved, of those that have one for all; else null.
  virtual LinearSolver* linear() { return nullptr; }
  /// As LinearSolver's, of those that solve linear systems; `assemble` writes the matrix at rest.
  virtual bool learnsFromRest(bool /*lasting*/) const { return false; }
  virtual void learnFromRest(const std::function<void(fem::Stiffness*)>& /*assemble*/) {}
  /// The first cycle after a restart is about to minimise `potential` near x: time for work that
  /// would take too long later.
  virtual void prepare(const Potential& /*potential*/, const Points& /*x*/) {}
  /// The next cycle, of `dt` [s], begins: the only time at which work that was done beside is taken
  /// into use.
  virtual void beginCycle(double /*dt*/) {}
  /// Forgets what it learnt: from here on it does what a new one would.
  virtual void restart() {}
  /// All that it learnt. Work that is being done beside goes on; it is saved as what it is done on.
  virtual void save(StateWriter* out) const = 0;
  /// @throws std::invalid_argument for the memory of another kind or of another body.
  virtual void restore(StateReader* in) = 0;
  /// Cycles that began with waiting for work that was done beside; the only figure that depends on
  /// how fast it was.
  virtual int waits() const { return 0; }
};

}  // namespace palpate::solver
