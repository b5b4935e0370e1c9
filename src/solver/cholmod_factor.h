// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>

#include <memory>

#include "cholmod_matrix.h"
#include "palpate/solver/status.h"

namespace palpate::solver {

/// A Cholesky factor of a stiffness, by CHOLMOD with a workspace of its own: two of them may work
/// in two threads. Symbolic analysis is done once: every matrix must have the pattern of the first.
class CholmodFactor {
 public:
  CholmodFactor();
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// Symbolic analysis, if it has not been done.
  void analyze(const fem::Stiffness& A);
  /// kNotPositiveDefinite, kNonFinite: there is no factor any more.
  SolveStatus factorize(const fem::Stiffness& A);
  /// x = A^-1 b, both 3 x n, with the last matrix that had a factor. kNonFinite if x is not finite.
  SolveStatus solve(const Points& b, Points* x);

  /// Multiplications and additions of one factorize(), after analyze().
  double flops() const { return common_.fl; }
  /// Numbers in the factor, after analyze().
  double nonzeros() const { return common_.lnz; }

 private:
  bool positiveDefinite() const;

  cholmod_common common_;
  std::unique_ptr<CholmodMatrix> matrix_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *solution_ = nullptr, *work_y_ = nullptr, *work_e_ = nullptr;
  Eigen::VectorXd padded_;
};

}  // namespace palpate::solver
