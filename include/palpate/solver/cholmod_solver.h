// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

class FactorPcg;
class PressureSystem;
class StaleFactor;

/// Sparse Cholesky by CHOLMOD (supernodal where it pays). The order is found at the first solve and
/// kept, the symbolic analysis as long as the same nodes are coupled; apart from couplings every
/// matrix must have the pattern of the first one.
///
/// Of a matrix with volumes the rest is factorised, if that is positive definite and cheaper, and
/// pressures are found by iterations, to the tolerance asked for and 1e-3 at least; otherwise all
/// of it is.
///
/// A factor of all of a matrix serves those of its cycle that follow, which differ by contact and
/// by what a Newton step moved: as the preconditioner of conjugate gradients, to the same
/// tolerance, in no more iterations than cost as much as another factor. Where these find nothing,
/// a matrix is factorised, and the next 1, 2, 4 ... of the cycle at once.
class CholmodSolver final : public LinearSolver {
 public:
  CholmodSolver();
  ~CholmodSolver() override;

  LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                     Points* x) override;
  void beginCycle(double dt) override;
  void restart() override { beginCycle(0.0); }
  void restore(StateReader* in) override;

  /// What the factor for A and a solve with it take [s], by unit_costs.h: nothing is factorised.
  double seconds(const fem::Stiffness& A);

 private:
  bool iterationsPay(const fem::Stiffness& A);
  bool solveByEarlierFactor(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                            Points* x, LinearReport* report);

  std::unique_ptr<StaleFactor> factor_;
  std::unique_ptr<FactorPcg> iterations_;
  std::unique_ptr<PressureSystem> pressures_;
  int factors_left_ = 0;  // matrices that are factorised at once
  int factors_next_ = 1;  // likewise, after the next failure
};

}  // namespace palpate::solver
