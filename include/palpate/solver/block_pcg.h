// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

/// Conjugate gradients preconditioned by the inverses of the 3 x 3 diagonal blocks [Saad 2003,
/// alg. 9.1]. Starts from zero, so that every iterate is a direction of descent.
class BlockPcg final : public LinearSolver {
 public:
  explicit BlockPcg(int max_iterations) : max_iterations_(max_iterations) {}

  LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                     Points* x) override;

 private:
  bool invertDiagonal(const fem::Stiffness& A);
  void precondition(const Points& r, Points* z) const;

  int max_iterations_;
  std::vector<Mat3> inverse_diagonal_;
  Points r_, z_, p_, Ap_;
};

}  // namespace palpate::solver
