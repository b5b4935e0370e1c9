// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

/// Conjugate gradients with a Cholesky factor as fallback. Nearly incompressible elements and
/// stiffness ratios of 1e4 and more exhaust the iterations, or let rounding report an indefinite
/// matrix. Failed iterations are summed, with decay over cycles. Where two or more solves have cost
/// as much as a factor (unit_costs.h), factors solve the rest of the cycle and the next 1, 2, 4 ...
/// 64 cycles. This is the ski-rental rule: at most about twice the optimal cost [Karlin et al.
/// 1988].
class PcgOrFactor final : public LinearSolver {
 public:
  explicit PcgOrFactor(BlockPcg pcg) : pcg_(std::move(pcg)) {}

  LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                     Points* x) override;
  void takePattern(const fem::Stiffness& A) override { pcg_.takePattern(A); }
  bool learnsFromRest(bool lasting) const override { return pcg_.learnsFromRest(lasting); }
  void learnFromRest(const fem::Stiffness& A) override { pcg_.learnFromRest(A); }
  void onlyChanged(const std::vector<int>& slots) override;
  void beginCycle(double dt) override;
  void restart() override;
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

  BlockPcg* pcg() { return &pcg_; }

 private:
  bool factorPays(const fem::Stiffness& A);

  BlockPcg pcg_;
  CholmodSolver factor_;
  int cycles_left_ = 0;          // that factors take whole
  int cycles_next_ = 1;          // likewise, after the next failure
  double in_vain_ = 0.0;         // iterations, those of earlier cycles for less
  double solves_in_vain_ = 0.0;  // likewise
  bool factorises_ = false;      // to the end of the cycle
  bool taken_ = false;           // the last matrix, by pcg_
};

}  // namespace palpate::solver
