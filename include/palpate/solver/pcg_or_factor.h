// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

/// Conjugate gradients, and a Cholesky factor where they find no solution: in elements next to the
/// incompressible and across stiffness ratios of 1e4 and more they end at their limit, or call a
/// matrix indefinite that is not, by the rounding of their products. Iterations in vain are added
/// up, those of earlier cycles for less; once two solves or more have cost what a factor does, by
/// unit_costs.h, factors take what is left of the cycle and 1, 2, 4 ... 64 cycles that follow,
/// until iterations do for one again: never much more than twice the work of what would have been
/// best from the start, as where skis are hired until that costs as much as buying them
/// [Karlin et al. 1988].
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
