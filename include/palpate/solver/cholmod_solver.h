// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

class CholmodFactor;
class PressureSystem;

/// Sparse Cholesky by CHOLMOD (supernodal where it pays). The order is found at the first solve and
/// kept, the symbolic analysis as long as the same nodes are coupled; apart from couplings every
/// matrix must have the pattern of the first one.
///
/// Of a matrix with volumes the rest is factorised, if that is positive definite and cheaper, and
/// pressures are found by iterations, to the tolerance asked for and 1e-3 at least; otherwise all
/// of it is.
class CholmodSolver final : public LinearSolver {
 public:
  CholmodSolver();
  ~CholmodSolver() override;

  LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                     Points* x) override;

  /// What the factor for A and a solve with it take [s], by unit_costs.h: nothing is factorised.
  double seconds(const fem::Stiffness& A);

 private:
  bool iterationsPay(const fem::Stiffness& A);

  std::unique_ptr<CholmodFactor> factor_;
  std::unique_ptr<PressureSystem> pressures_;
};

}  // namespace palpate::solver
