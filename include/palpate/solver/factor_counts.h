// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// Of a Cholesky factor.
struct FactorCounts {
  double flops = 0.0;     ///< Multiplications and additions that make it.
  double nonzeros = 0.0;  ///< Numbers in it.
};

/// By the symbolic analysis of A's pattern: nothing is factorised.
FactorCounts countFactor(const fem::Stiffness& A);

}  // namespace palpate::solver
