// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/base/background.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

class FactorPcg;
class StaleFactor;

/// Conjugate gradients preconditioned by the Cholesky factor of an earlier matrix, made in the
/// background [Courtecuisse et al. 2014, sec. 4]. A factorisation begun in cycle k is used from
/// cycle k + m on, m by its number of operations, so results do not depend on machine speed.
/// Without a factor it is BlockPcg. Where failed iterations cost as much as a factor, one is made
/// at once.
class StalePcg final : public LinearSolver {
 public:
  /// `A`: pattern of all later matrices, analysed here. `own_thread`: factorise in a background
  /// thread, else when the factor is used, with the same results.
  StalePcg(const fem::Stiffness& A, int max_iterations, bool own_thread);
  ~StalePcg() override;

  LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                     Points* x) override;
  bool prepares() const override { return true; }
  /// Factorises A at once.
  void prepare(const fem::Stiffness& A) override;
  void beginCycle(double dt) override;
  void restart() override;
  /// Writes the matrices of both factors; restore() factorises them again.
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;
  int waits() const override { return waits_; }

 private:
  LinearReport iterate(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                       Points* x);
  LinearReport iterateWithout(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                              Points* x);
  double iterationSeconds(const fem::Stiffness& A) const;
  int mostIterations(const fem::Stiffness& A) const;
  void beginFactor(const fem::Stiffness& A);
  void factoriseSnapshot();

  int max_iterations_;
  double flops_ = 0.0;  // of a factorisation without couplings: how long one may take
  BlockPcg plain_;
  std::unique_ptr<StaleFactor> used_, next_;
  std::unique_ptr<FactorPcg> iterations_;
  fem::Stiffness snapshot_;
  long cycle_ = 0, take_at_ = 0;
  double dt_ = 0.0;
  int most_iterations_ = 0;  // of a solve since the last factor was begun
  double in_vain_ = 0.0;     // [s] of iterations, those of earlier cycles for less
  bool is_older_ = false;    // what is being made than what is used
  bool wanted_ = true;
  int waits_ = 0;
  std::unique_ptr<Background> background_;  // last member: destroyed before the members it uses
};

}  // namespace palpate::solver
