// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "palpate/fem/rank_ones.h"
#include "palpate/solver/status.h"

namespace palpate::solver {

/// Solves (R + sum_j c_j a_j a_j^T) x = b, all 3 x n. `solve_rest` solves with R, once more for
/// each j [Sherman, Morrison 1950; Woodbury 1950]:
///
///   x = R^-1 b - Z (diag(1/c) + U^T Z)^-1 U^T R^-1 b,   Z = R^-1 U, U the columns a_j
SolveStatus solveWithRankOnes(
    const fem::RankOnes& rank_ones,
    const std::function<SolveStatus(const Points& right, Points* solution)>& solve_rest,
    const Points& b, Points* x);

}  // namespace palpate::solver
