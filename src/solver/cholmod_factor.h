// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>

#include <memory>
#include <vector>

#include "cholmod_matrix.h"
#include "ordered_matrix.h"
#include "palpate/solver/status.h"

namespace palpate::solver {

/// A Cholesky factor of a stiffness by CHOLMOD, with its own workspace, so that instances can run
/// in different threads. All matrices have the pattern of the first, apart from couplings. The
/// fill-reducing order is that of the matrix without couplings; changed couplings need a new
/// symbolic analysis in that order. So factors are exact, detect indefinite matrices, and do not
/// depend on earlier couplings.
class CholmodFactor {
 public:
  explicit CholmodFactor(Volumes volumes = Volumes::kIncluded);
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// Symbolic analysis, unless done for A's couplings.
  void analyze(const fem::Stiffness& A);
  /// After kNotPositiveDefinite or kNonFinite there is no factor.
  SolveStatus factorize(const fem::Stiffness& A);
  /// Computes x = A^-1 b, both 3 x n, by the last factor. kNonFinite: x is not finite.
  SolveStatus solve(const Points& b, Points* x);

  /// Multiplications and additions of factorize() for the last analysed matrix.
  double flops() const { return used_->flops; }
  /// Nonzeros of its factor.
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
  Analysed uncoupled_, coupled_;  // the second is for couplings, those of the last matrix
  Analysed* used_ = nullptr;      // one of them, for the last matrix
  std::vector<int> order_;        // order of the uncoupled matrix, used for all
  cholmod_dense *solution_ = nullptr, *work_y_ = nullptr, *work_e_ = nullptr;
  Eigen::VectorXd padded_;
};

}  // namespace palpate::solver
