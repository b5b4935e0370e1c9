// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/base/isa.h"
#include "palpate/base/thread_pool.h"
#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

/// Conjugate gradients preconditioned by the inverses of the 3 x 3 diagonal blocks [Saad 2003,
/// alg. 9.1] and, in long bodies, a coarse space, which is that of the body at rest. Starts from
/// zero, so that every iterate is a direction of descent.
///
/// Vectors are in double precision, products with the matrix are computed in single precision,
/// which is less than half the work. A tolerance that this could miss is met by iterative
/// refinement with the matrix itself [Moler 1967]. All matrices must have the pattern of the first
/// one; couplings outside the pattern are added to the products block by block.
class BlockPcg final : public LinearSolver {
 public:
  /// `pool` may be null (one thread) and must outlive the solver; it changes no bit of x. `points`,
  /// 3 x n: where nodes are, for the coarse space; empty: there is none.
  explicit BlockPcg(int max_iterations, ThreadPool* pool = nullptr, Isa isa = bestIsa(),
                    const Points& points = {});
  /// For matrices of several bodies side by side, each of which has a solver that has taken its
  /// pattern: in their orders, and with the coarse spaces that they have by now. They must outlive
  /// this, and may be used in turn with it.
  BlockPcg(int max_iterations, ThreadPool* pool, const std::vector<BlockPcg*>& bodies);
  BlockPcg(BlockPcg&&) noexcept;
  ~BlockPcg() override;

  /// What an iteration with A takes [s], by unit_costs.h.
  static double iterationSeconds(const fem::Stiffness& A);

  LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                     Points* x) override;
  void takePattern(const fem::Stiffness& A) override;
  void onlyChanged(const std::vector<int>& slots) override;
  bool learnsFromRest(bool lasting) const override;
  void learnFromRest(const fem::Stiffness& A) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::solver
