// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

class CholmodFactor;

/// Sparse Cholesky by CHOLMOD (supernodal where it pays). The order is found at the first solve and
/// kept, the symbolic analysis as long as the same nodes are coupled; apart from couplings every
/// matrix must have the pattern of the first one.
class CholmodSolver final : public LinearSolver {
 public:
  CholmodSolver();
  ~CholmodSolver() override;

  LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                     Points* x) override;

 private:
  std::unique_ptr<CholmodFactor> factor_;
};

}  // namespace palpate::solver
