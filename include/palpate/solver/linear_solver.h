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
  int iterations = 0;  ///< Zero of a matrix that was factorised alone.
  /// At its limit, or where it takes A for indefinite that is not: `x` may be of little use.
  bool in_vain = false;
};

/// Solves A x = b, A symmetric positive definite with a pattern that is always the same but for its
/// couplings.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// `b` and `x` are 3 x n; `x` is overwritten. An iterative solver stops when |b - A x| <=
  /// `relative_tolerance` |b|. kNotPositiveDefinite: A is not, and `x` is of no use;
  /// kIterationLimit, kDeadline: `x` is the best so far, still a direction of descent, also where
  /// iterations find only then that A is not positive definite.
  virtual LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                             Points* x) = 0;

  /// What can be done for the matrices to come, of which only A's pattern is known: spares the
  /// first solve().
  virtual void takePattern(const fem::Stiffness& /*A*/) {}
  /// Whether learnFromRest() is of use, of a body that is `lasting`, or soon has another mesh.
  virtual bool learnsFromRest(bool /*lasting*/) const { return false; }
  /// A is the matrix of the body at rest, which those to come are like: something to be kept for
  /// good, and never changed by what is solved.
  virtual void learnFromRest(const fem::Stiffness& /*A*/) {}
  /// Just before a solve(): since the one before, A has changed only in its blocks on the diagonal,
  /// in these slots off it and in its couplings. Unsaid, it may have changed anywhere.
  virtual void onlyChanged(const std::vector<int>& /*slots*/) {}

  /// Whether prepare() is of use: the first system after a restart, before there is one to solve.
  virtual bool prepares() const { return false; }
  virtual void prepare(const fem::Stiffness& /*A*/) {}
  /// The next cycle, of `dt` [s], begins: the only time at which work that was done beside is taken
  /// into use.
  virtual void beginCycle(double /*dt*/) {}
  /// Forgets what it learnt from earlier systems: from here on it does what a new one would.
  virtual void restart() {}
  /// All that it learnt; nothing, for most.
  virtual void save(StateWriter* /*out*/) const {}
  /// @throws std::invalid_argument for the memory of another kind or of another body.
  virtual void restore(StateReader* /*in*/) {}
  /// Cycles that began with waiting for work that was done beside; the only figure that depends on
  /// how fast it was.
  virtual int waits() const { return 0; }

  /// Asked every few iterations; null: nobody is.
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
