// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/fem/stiffness.h"
#include "palpate/solver/interrupt.h"
#include "palpate/solver/status.h"

namespace palpate::solver {

struct LinearReport {
  SolveStatus status = SolveStatus::kConverged;
  int iterations = 0;  ///< Iterations; 0 for a direct solve.
  /// Whether iterations reached their limit, or wrongly report an indefinite A; `x` may be poor.
  bool in_vain = false;
};

/// Solves A x = b with symmetric positive definite A of a fixed pattern, except for couplings.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// `b` and `x` are 3 x n; `x` is overwritten. An iterative solver stops when |b - A x| <=
  /// `relative_tolerance` |b|. With kNotPositiveDefinite, `x` is invalid; with kIterationLimit or
  /// kDeadline, `x` is a descent direction.
  virtual LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                             Points* x) = 0;

  /// Analyses the pattern of A for later matrices.
  virtual void takePattern(const fem::Stiffness& /*A*/) {}
  /// Whether learnFromRest() is useful; `lasting`: the mesh stays.
  virtual bool learnsFromRest(bool /*lasting*/) const { return false; }
  /// Precomputes from A, the matrix at rest; later solves do not change the result.
  virtual void learnFromRest(const fem::Stiffness& /*A*/) {}
  /// Declares before a solve() that A has changed only in diagonal blocks, these off-diagonal slots
  /// and couplings since the last one. Without it, all of A may have changed.
  virtual void onlyChanged(const std::vector<int>& /*slots*/) {}

  /// Whether prepare() is useful before the first system after a restart.
  virtual bool prepares() const { return false; }
  virtual void prepare(const fem::Stiffness& /*A*/) {}
  /// Begins a cycle of `dt` [s]; results of background tasks are taken into use only here.
  virtual void beginCycle(double /*dt*/) {}
  /// Drops the cached solver state: later results are those of a new solver.
  virtual void restart() {}
  /// Writes the cached solver state; empty for most solvers.
  virtual void save(StateWriter* /*out*/) const {}
  /// @throws std::invalid_argument for the state of another solver or body.
  virtual void restore(StateReader* /*in*/) {}
  /// Cycles that waited for a background task; the only figure that depends on machine speed.
  virtual int waits() const { return 0; }

  /// Sets the predicate polled every few iterations; may be null.
  void setInterrupt(const Interrupt* interrupt) { interrupt_ = interrupt; }

 protected:
  const Interrupt* interrupt() const { return interrupt_; }
  bool interrupted(int iteration) const {
    return iteration > 0 && iteration % 8 == 0 && isInterrupted(interrupt_);
  }

 private:
  const Interrupt* interrupt_ = nullptr;
};

}  // namespace palpate::solver
