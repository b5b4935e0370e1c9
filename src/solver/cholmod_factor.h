// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>

#include <memory>
#include <vector>

#include "cholmod_matrix.h"
#include "ordered_matrix.h"
#include "palpate/solver/status.h"

namespace palpate::solver {

/// A Cholesky factor of a stiffness, by CHOLMOD with a workspace of its own: two of them may work
/// in two threads. Every matrix must have the pattern of the first, apart from couplings. A matrix
/// without any is ordered and analysed once; one that couples other nodes than the one before is
/// analysed again, in the same order. So every factor is exact, says whether its matrix is
/// definite, and does not depend on what was coupled before.
class CholmodFactor {
 public:
  explicit CholmodFactor(Volumes volumes = Volumes::kIncluded);
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// Symbolic analysis, if it has not been done for what A couples.
  void analyze(const fem::Stiffness& A);
  /// kNotPositiveDefinite, kNonFinite: there is no factor any more.
  SolveStatus factorize(const fem::Stiffness& A);
  /// x = A^-1 b, both 3 x n, with the last matrix that had a factor. kNonFinite if x is not finite.
  SolveStatus solve(const Points& b, Points* x);

  /// Multiplications and additions of one factorize() of the matrix that was analysed last.
  double flops() const { return used_->flops; }
  /// Numbers in its factor.
  double nonzeros() const { return used_->nonzeros; }

 private:
  struct Analysed {
    std::unique_ptr<CholmodMatrix> matrix;
    cholmod_factor* factor = nullptr;
    std::unique_ptr<OrderedMatrix> ordered;  // null: the factor is not supernodal
    double flops = 0.0, nonzeros = 0.0;
  };

  bool positiveDefinite() const;
  void analyzeUncoupled(const fem::Stiffness& A);
  void takeFactor(Analysed* analysed, cholmod_factor* factor);

  Volumes volumes_;
  cholmod_common common_;
  Analysed uncoupled_, coupled_;  // the second where there are couplings, those of the last matrix
  Analysed* used_ = nullptr;      // one of them, by the last matrix
  std::vector<int> order_;        // of the matrix without couplings, and so of all
  cholmod_dense *solution_ = nullptr, *work_y_ = nullptr, *work_e_ = nullptr;
  Eigen::VectorXd padded_;
};

}  // namespace palpate::solver
