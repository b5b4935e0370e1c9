// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/factor_counts.h"

#include "cholmod_factor.h"

namespace palpate::solver {

FactorCounts countFactor(const fem::Stiffness& A) {
  CholmodFactor factor;
  factor.analyze(A);
  return {factor.flops(), factor.nonzeros()};
}

}  // namespace palpate::solver
