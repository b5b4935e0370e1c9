// SPDX-License-Identifier: GPL-3.0-or-later
#include "minimizer_parts.h"

#include <cmath>
#include <vector>

#include "palpate/solver/line_search.h"

namespace palpate::solver {

bool isOver(double value, const Points& g, const fem::FreeMask& free,
            const NewtonSettings& settings, int max_iterations, NewtonReport* report) {
  report->residual = freeNorm(g, free);
  if (!std::isfinite(value) || !std::isfinite(report->residual)) {
    report->status = SolveStatus::kNonFinite;
    return true;
  }
  if (report->residual <= settings.tolerance) return true;
  if (report->iterations == max_iterations) {
    report->status = SolveStatus::kIterationLimit;
    return true;
  }
  if (report->iterations >= settings.least_iterations && settings.interrupted()) {
    report->status = SolveStatus::kDeadline;
    return true;
  }
  return false;
}

bool tangentSystem(const Potential& potential, const Points& x, const Points& move,
                   fem::Stiffness* A, Points* g, Points* right) {
  const double value = potential.gradient(x, g);
  if (!std::isfinite(value) || !g->allFinite()) return false;
  potential.hessian(x, fem::Tangent::kProjected, A);
  A->multiply(move, right);
  *right = -(*g + *right).cwiseProduct(potential.free);
  A->constrain(potential.free);
  return true;
}

SolveStatus moveIfFinite(const Potential& potential, const Points& move, const Points& d, Points* x,
                         Points* scratch) {
  *scratch = *x + move + d;
  if (!std::isfinite(potential.value(*scratch))) return SolveStatus::kLineSearchFailed;
  x->swap(*scratch);
  return SolveStatus::kConverged;
}

double roundoffForce(const fem::Stiffness& A, const Points& x) {
  double stiffness = 0.0;
  std::vector<Mat3> diagonal;
  A.diagonal(&diagonal);
  for (const Mat3& block : diagonal) stiffness += block.trace();
  return 1e-15 * stiffness / (3.0 * A.numNodes()) * x.norm();
}

}  // namespace palpate::solver
