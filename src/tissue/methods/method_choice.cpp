// SPDX-License-Identifier: GPL-3.0-or-later
#include "method_choice.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

#include "palpate/solver/unit_costs.h"

namespace palpate::tissue {
namespace {

// Solves of a cycle with contact; scenes change them equally for all implicit methods.
constexpr double kNewtonIterations = 2.0;
constexpr double kLbfgsIterations = 8.0;
// Cycles per renewal of a stale factor.
constexpr double kCyclesOfAFactor = 30.0;

// Largest cost relative to the default method [-]. The bound is stricter for explicit methods,
// whose damping and contact differ.
constexpr double kClearlyCheaper = 0.8;
constexpr double kExplicitCheaper = 0.6;
// Poisson ratio above which compressed elements shorten the explicit step [-].
constexpr double kExplicitPoisson = 0.49;

struct Estimate {
  const char* method;
  double seconds;
};

std::vector<Estimate> implicitEstimates(const CycleCounts& c) {
  const double gradient = solver::gradientSeconds(c.tets);
  const double tangent = solver::tangentSeconds(c.tets);
  const double factor = solver::factorizationSeconds(c.factor_flops);
  const double back = solver::triangularSolveSeconds(c.factor_nonzeros);
  const double pcg = solver::packingSeconds(c.blocks) +
                     c.linear_iterations * solver::pcgIterationSeconds(c.blocks, c.volume_entries);
  return {
      {"implicit_pcg", kNewtonIterations * (tangent + pcg)},
      {"implicit_direct", kNewtonIterations * (tangent + c.direct)},
      {"lbfgs", kLbfgsIterations * (gradient + back) + (tangent + factor) / kCyclesOfAFactor},
  };
}

// Reason against `tled`; empty: none.
std::string explicitObstacle(const CycleCounts& c) {
  if (!c.explicit_accepts) return "it does not take these settings";
  if (!(c.poisson_ratio <= kExplicitPoisson)) return "poisson_ratio above 0.49";
  if (!c.mass_damping) return "without damping.mass it would ring";
  return "";
}

std::string inMilliseconds(const Estimate& estimate) {
  std::ostringstream text;
  text << estimate.method << " " << std::setprecision(2) << 1e3 * estimate.seconds << " ms";
  return text.str();
}

}  // namespace

MethodChoice chooseMethod(const CycleCounts& counts) {
  const std::vector<Estimate> estimates = implicitEstimates(counts);
  const Estimate usual = estimates.front();
  Estimate best = usual;
  for (const Estimate& e : estimates) {
    if (e.seconds < std::min(kClearlyCheaper * usual.seconds, best.seconds)) best = e;
  }
  const Estimate explicit_one{"tled", counts.sub_steps * solver::gradientSeconds(counts.tets)};
  const std::string obstacle = explicitObstacle(counts);
  if (obstacle.empty() && explicit_one.seconds < kExplicitCheaper * best.seconds)
    best = explicit_one;

  std::ostringstream reason;
  reason << "method auto takes " << best.method << ", estimated for a cycle with contact: ";
  for (const Estimate& e : estimates) reason << inMilliseconds(e) << ", ";
  reason << inMilliseconds(explicit_one);
  if (!obstacle.empty()) reason << " (not taken: " << obstacle << ")";
  reason << "; counted: " << counts.linear_iterations << " iterations of conjugate gradients, "
         << std::setprecision(3) << counts.factor_nonzeros << " numbers in a factor, "
         << counts.sub_steps << " explicit sub-steps";
  return {best.method, reason.str()};
}

}  // namespace palpate::tissue
