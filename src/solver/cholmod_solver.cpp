// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/cholmod_solver.h"

#include <algorithm>

#include "cholmod_factor.h"
#include "palpate/solver/unit_costs.h"
#include "pressure_system.h"
#include "rank_one_correction.h"

namespace palpate::solver {
namespace {

// What Newton's method gains by a factor, iterations for pressures must not lose.
constexpr double kLoosest = 1e-3, kTightest = 1e-12;
// So many iterations are cheaper than the factor of a matrix over two rings of elements, always.
constexpr double kFewIterations = 30.0;
// For few right sides solves take 2.6 times what unit_costs.h says, for large fronts factors
// a 2.3th of it: pressed cube of 24,576 tetrahedra, AVX-512.
constexpr double kSolveBesideFactor = 6.0;

}  // namespace

CholmodSolver::CholmodSolver()
    : factor_(std::make_unique<CholmodFactor>()), pressures_(std::make_unique<PressureSystem>()) {}
CholmodSolver::~CholmodSolver() = default;

// By A and the number of operations alone.
bool CholmodSolver::iterationsPay(const fem::Stiffness& A) {
  const double iterations = pressures_->prepare(A);
  if (iterations <= kFewIterations || !A.volume().metric->isDiagonal()) return true;
  const CholmodFactor& own = pressures_->analyze(A);
  const double each = kSolveBesideFactor * triangularSolveSeconds(own.nonzeros());
  factor_->analyze(A);
  return factorizationSeconds(own.flops()) + iterations * each <
         factorizationSeconds(factor_->flops());
}

double CholmodSolver::seconds(const fem::Stiffness& A) {
  const bool iterates = A.hasVolume() && iterationsPay(A);
  if (!iterates) factor_->analyze(A);
  const CholmodFactor& factor = iterates ? pressures_->analyze(A) : *factor_;
  const double solves = iterates ? pressures_->prepare(A) : 1.0;
  return factorizationSeconds(factor.flops()) + solves * triangularSolveSeconds(factor.nonzeros());
}

LinearReport CholmodSolver::solve(const fem::Stiffness& A, const Points& b,
                                  double relative_tolerance, Points* x) {
  if (!b.allFinite()) return {SolveStatus::kNonFinite, 0};
  if (A.hasVolume() && iterationsPay(A) && pressures_->factorize(A) == SolveStatus::kConverged) {
    const double tolerance = std::clamp(relative_tolerance, kTightest, kLoosest);
    const auto solve_rest = [&](const Points& right, Points* solution) {
      return pressures_->solve(A, right, tolerance, solution).status;
    };
    const SolveStatus status = solveWithRankOnes(A.rankOnes(), solve_rest, b, x);
    if (status == SolveStatus::kConverged) return {status, 0};
  }
  const SolveStatus status = factor_->factorize(A);
  if (status != SolveStatus::kConverged) return {status, 0};
  const auto solve_rest = [&](const Points& right, Points* solution) {
    return factor_->solve(right, solution);
  };
  return {solveWithRankOnes(A.rankOnes(), solve_rest, b, x), 0};
}

}  // namespace palpate::solver
