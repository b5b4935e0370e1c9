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
  /// Polled after every iteration and in linear solves; may be null.
  const Interrupt* interrupt = nullptr;
  /// Iterations before `interrupt` is polled: 1, or 0 after a tangent step.
  int least_iterations = 1;
  /// Line search halvings before `interrupt` is polled.
  int least_halvings = 8;

  bool interrupted() const { return isInterrupted(interrupt); }
};

struct NewtonReport {
  SolveStatus status = SolveStatus::kConverged;
  int iterations = 0;  ///< Steps taken.
  int halvings = 0;    ///< Line search halvings.
  int linear_iterations = 0;
  int projections = 0;       ///< Linear systems made positive definite by projection.
  int kept_stiffnesses = 0;  ///< Elastic stiffnesses that were reused.
  double residual = 0.0;     ///< Norm of the free gradient at the end [N].
  PhaseTimes phases;
};

class LinearSolver;

/// Minimises potentials of one body in sequence. Keeps buffers and cached solver state between
/// calls.
class Minimizer {
 public:
  virtual ~Minimizer() = default;

  /// Minimises over the free components of x, 3 x n [m]. The value never grows; x is always finite.
  virtual NewtonReport minimize(const Potential& potential, const NewtonSettings& settings,
                                Points* x) = 0;
  /// Number of its iterations that count as one of `max_iterations`.
  virtual int iterationsForOne() const { return 1; }
  /// Estimated time of a factorisation inside a solve, which is not interruptible [s]; 0: none or
  /// unknown.
  virtual double factorSeconds() const { return 0.0; }
  /// Moves held components by `move`, 3 x n [m], zero where free, and free ones by the tangent at
  /// x, as start of the next load step. x is unchanged where the solve fails.
  virtual SolveStatus predict(const Potential& potential, const Points& move, Points* x) = 0;

  /// Solves A d = push - g for the step d, 3 x n [m]. `push`: an added force, 3 x n [N].
  /// Adds the cost to `report`. Returns false on failure or where not supported.
  virtual bool tangentStep(const Potential& /*potential*/, const Points& /*x*/,
                           const Points& /*push*/, double /*linear_tolerance*/, Points* /*d*/,
                           NewtonReport* /*report*/) {
    return false;
  }

  /// Gradient at the end of the last minimize(), 3 x n [N]; on held components the support force.
  virtual const Points& gradient() const = 0;
  /// Norm of the rounding error of forces at x, by the last matrix [N]: lower bound of residuals.
  virtual double roundoffForce(const Points& x) const = 0;

  /// Linear solver, or null.
  virtual LinearSolver* linear() { return nullptr; }
  /// As LinearSolver::learnsFromRest() and learnFromRest(); `assemble` writes the matrix at rest.
  virtual bool learnsFromRest(bool /*lasting*/) const { return false; }
  virtual void learnFromRest(const std::function<void(fem::Stiffness*)>& /*assemble*/) {}
  /// Prepares for minimising `potential` near x, before the first cycle after a restart.
  virtual void prepare(const Potential& /*potential*/, const Points& /*x*/) {}
  /// Begins a cycle of `dt` [s]; results of background tasks are taken into use only here.
  virtual void beginCycle(double /*dt*/) {}
  /// Drops the cached solver state: later results are those of a new minimiser.
  virtual void restart() {}
  /// Writes the cached solver state; of a background task its input.
  virtual void save(StateWriter* out) const = 0;
  /// @throws std::invalid_argument for the state of another minimiser or body.
  virtual void restore(StateReader* in) = 0;
  /// Cycles that waited for a background task; the only figure that depends on machine speed.
  virtual int waits() const { return 0; }
};

}  // namespace palpate::solver
