// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/cholmod_solver.h"

#include <algorithm>

#include "factor_pcg.h"
#include "palpate/solver/unit_costs.h"
#include "pressure_system.h"
#include "rank_one_correction.h"
#include "stale_factor.h"

namespace palpate::solver {
namespace {

// Range of relative tolerances: iterations must not lose the precision that a factor would give.
constexpr double kLoosest = 1e-3, kTightest = 1e-12;
// Estimated iterations below which iterating always beats factorising over two rings of elements.
constexpr double kIterationsBelowFactor = 30.0;
// Correction of unit_costs.h: solves with few right-hand sides take 2.6 times as long, factors of
// large fronts 1/2.3 times. Measured: pressed cube of 24,576 tetrahedra, AVX-512.
constexpr double kSolveCostOverFactor = 6.0;
// Iterations that cost about as much as a factor. Measured: 12 to 27 for blocks of 64 to 6859
// nodes, 37 to 150 with averaged volumes; AMD EPYC, during a build. Random scenes take as long with
// 12, and a tenth longer with 7.
constexpr int kMostFactorIterations = 20;
constexpr int kMostFactors = 64;

double within(double relative_tolerance) {
  return std::clamp(relative_tolerance, kTightest, kLoosest);
}

}  // namespace

CholmodSolver::CholmodSolver()
    : factor_(std::make_unique<StaleFactor>()),
      iterations_(std::make_unique<FactorPcg>()),
      pressures_(std::make_unique<PressureSystem>()) {}
CholmodSolver::~CholmodSolver() = default;

// Decided by A and operation counts alone.
bool CholmodSolver::iterationsPay(const fem::Stiffness& A) {
  const double iterations = pressures_->prepare(A);
  if (iterations <= kIterationsBelowFactor || !A.volume().metric->isDiagonal()) return true;
  const CholmodFactor& own = pressures_->analyze(A);
  const double each = kSolveCostOverFactor * triangularSolveSeconds(own.nonzeros());
  factor_->analyze(A);
  return factorizationSeconds(own.flops()) + iterations * each <
         factorizationSeconds(factor_->factor().flops());
}

double CholmodSolver::seconds(const fem::Stiffness& A) {
  const bool iterates = A.hasVolume() && iterationsPay(A);
  if (!iterates) factor_->analyze(A);
  const CholmodFactor& factor = iterates ? pressures_->analyze(A) : factor_->factor();
  const double solves = iterates ? pressures_->prepare(A) : 1.0;
  return factorizationSeconds(factor.flops()) + solves * triangularSolveSeconds(factor.nonzeros());
}

void CholmodSolver::beginCycle(double /*dt*/) {
  factor_->forget();
  factors_left_ = 0;
  factors_next_ = 1;
}

// No state outlives a cycle.
void CholmodSolver::restore(StateReader* /*in*/) { restart(); }

// Returns false if the matrix must be factorised.
bool CholmodSolver::solveByEarlierFactor(const fem::Stiffness& A, const Points& b,
                                         double relative_tolerance, Points* x,
                                         LinearReport* report) {
  if (!factor_->ready()) return false;
  if (factors_left_ > 0) {
    --factors_left_;
    return false;
  }
  *report = iterations_->solve(A, b, within(relative_tolerance), kMostFactorIterations, interrupt(),
                               factor_.get(), x);
  if (usable(report->status) && (!report->in_vain || isInterrupted(interrupt()))) return true;
  factors_left_ = factors_next_;
  factors_next_ = std::min(kMostFactors, 2 * factors_next_);
  return false;
}

LinearReport CholmodSolver::solve(const fem::Stiffness& A, const Points& b,
                                  double relative_tolerance, Points* x) {
  if (!b.allFinite()) return {SolveStatus::kNonFinite, 0};
  LinearReport report;
  if (solveByEarlierFactor(A, b, relative_tolerance, x, &report)) return report;
  if (A.hasVolume() && iterationsPay(A) && pressures_->factorize(A) == SolveStatus::kConverged) {
    const double tolerance = within(relative_tolerance);
    const auto solve_rest = [&](const Points& right, Points* solution) {
      return pressures_->solve(A, right, tolerance, solution).status;
    };
    const SolveStatus status = solveWithRankOnes(A.rankOnes(), solve_rest, b, x);
    if (status == SolveStatus::kConverged) return {status, report.iterations};
  }
  const SolveStatus status = factor_->factorize(A);
  if (status != SolveStatus::kConverged) return {status, report.iterations};
  const auto solve_rest = [&](const Points& right, Points* solution) {
    return factor_->solve(right, solution);
  };
  return {solveWithRankOnes(A.rankOnes(), solve_rest, b, x), report.iterations};
}

}  // namespace palpate::solver
