// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/line_search.h"

#include <cmath>

namespace palpate::solver {
namespace {

constexpr double kSufficientDecrease = 1e-4;
constexpr double kRoundoff = 1e-11;  // relative to the value: smaller differences are noise
// Largest step of a node in radii of gyration: one and a half times the diameter of a ball.
constexpr double kFarthest = 4.0;

double radiusOfGyration(const Points& x) {
  const Vec3 middle = x.rowwise().mean();
  return std::sqrt((x.colwise() - middle).squaredNorm() / static_cast<double>(x.cols()));
}

}  // namespace

double freeNorm(const Points& g, const fem::FreeMask& free) { return g.cwiseProduct(free).norm(); }

// Bounds steps of nodes without stiffness, which would fly off while the energy still falls. Only
// these are shortened; if the result is not downhill, all are.
const Points& LineSearch::bounded(const Points& x, const Points& g, const Points& d) {
  const double farthest = std::sqrt(d.colwise().squaredNorm().maxCoeff());
  const double most = kFarthest * radiusOfGyration(x);
  if (!(farthest > most)) return d;
  const auto part = (most / d.colwise().norm().array()).cwiseMin(1.0);
  d_ = d * part.matrix().asDiagonal();
  if (!(d_.cwiseProduct(g).sum() < 0.0)) d_ = most / farthest * d;
  return d_;
}

bool LineSearch::run(const Potential& potential, const Points& direction, Points* x, Points* g,
                     double* value, const Interrupt* interrupt, int least_halvings) {
  const Points& d = bounded(*x, *g, direction);
  const double slope = g->cwiseProduct(d).sum();
  const double norm = freeNorm(*g, potential.free);
  const bool conservative = potential.conservative();
  halvings_ = 0;
  if (conservative && slope > kRoundoff * std::abs(*value)) return false;  // uphill
  double alpha = potential.maxStep(*x, d);
  for (int k = 0; k <= kMaxHalvings; ++k, alpha *= 0.5) {
    if (k >= least_halvings && isInterrupted(interrupt)) return false;
    halvings_ = k;
    x_trial_ = *x + alpha * d;
    const double next_value = potential.gradient(x_trial_, &g_trial_);
    const double next_norm = freeNorm(g_trial_, potential.free);
    if (!std::isfinite(next_value) || !std::isfinite(next_norm)) continue;
    const bool smaller_residual = next_norm <= (1.0 - kSufficientDecrease * alpha) * norm;
    const bool decrease = next_value <= *value + kSufficientDecrease * alpha * slope;
    const bool in_the_noise = std::abs(alpha * slope) <= kRoundoff * std::abs(*value);
    if (conservative ? decrease || (in_the_noise && smaller_residual) : smaller_residual) {
      x->swap(x_trial_);
      g->swap(g_trial_);
      *value = next_value;
      return true;
    }
  }
  return false;
}

}  // namespace palpate::solver
