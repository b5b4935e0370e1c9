// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cholmod_factor.h"

namespace palpate::solver {

/// A Cholesky factor of some earlier matrix F that stands for a later one, A: S F S, with S block
/// diagonal such that the 3 x 3 diagonal blocks are those of A. Contact is what changes most from
/// one matrix to the next, and it is mostly on the diagonal. Always positive definite.
class StaleFactor {
 public:
  /// What a factor of A costs: factor(). Forgets the one that there is.
  void analyze(const fem::Stiffness& A) {
    factor_.analyze(A);
    if (matrix_.numNodes() == 0) matrix_ = A;
    ready_ = false;
  }
  /// Makes F = A. kNotPositiveDefinite, kNonFinite: there is no factor.
  SolveStatus factorize(const fem::Stiffness& A);
  /// F, if there is a factor, of the pattern that was analysed.
  void save(StateWriter* out) const;
  void restore(StateReader* in);
  bool ready() const { return ready_; }
  void forget() { ready_ = false; }

  /// The diagonal blocks of A; false if one is not positive definite.
  bool scaleTo(const std::vector<Mat3>& diagonal);
  /// x = F^-1 b, both 3 x n. kNonFinite if x is not finite.
  SolveStatus solve(const Points& b, Points* x) { return factor_.solve(b, x); }
  /// z = (S F S)^-1 r, both 3 x n; false if z is not finite.
  bool apply(const Points& r, Points* z);

  /// Those of F.
  const std::vector<Mat3>& diagonal() const { return diagonal_; }
  const CholmodFactor& factor() const { return factor_; }

 private:
  CholmodFactor factor_;
  fem::Stiffness matrix_;  // F, to make the factor again after a restore
  bool ready_ = false;
  std::vector<Mat3> diagonal_, inverse_scale_;  // S^-1
  Points scaled_;
};

}  // namespace palpate::solver
