// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cholmod_factor.h"

namespace palpate::solver {

/// The Cholesky factor of an earlier matrix F as a preconditioner for A: S F S, with S
/// block-diagonal such that the 3 x 3 diagonal blocks equal A's. Contact changes most between
/// matrices, mainly on the diagonal. Always positive definite.
class StaleFactor {
 public:
  /// Analyses A for the cost of its factor, in factor(). Discards the present factor.
  void analyze(const fem::Stiffness& A) {
    factor_.analyze(A);
    if (matrix_.numNodes() == 0) matrix_ = A;
    ready_ = false;
  }
  /// Sets F = A. After kNotPositiveDefinite or kNonFinite there is no factor.
  SolveStatus factorize(const fem::Stiffness& A);
  /// Saves F, if there is a factor with the analysed pattern.
  void save(StateWriter* out) const;
  void restore(StateReader* in);
  bool ready() const { return ready_; }
  void forget() { ready_ = false; }

  /// Scales to the diagonal blocks of A; false if one is not positive definite.
  bool scaleTo(const std::vector<Mat3>& diagonal);
  /// Computes x = F^-1 b, both 3 x n. kNonFinite: x is not finite.
  SolveStatus solve(const Points& b, Points* x) { return factor_.solve(b, x); }
  /// Computes z = (S F S)^-1 r, both 3 x n; false if z is not finite.
  bool apply(const Points& r, Points* z);

  /// Diagonal blocks of F.
  const std::vector<Mat3>& diagonal() const { return diagonal_; }
  const CholmodFactor& factor() const { return factor_; }

 private:
  CholmodFactor factor_;
  fem::Stiffness matrix_;  // F, to repeat the factorisation after a restore
  bool ready_ = false;
  std::vector<Mat3> diagonal_, inverse_scale_;  // S^-1
  Points scaled_;
};

}  // namespace palpate::solver
