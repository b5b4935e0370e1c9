// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/fitted_line.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "conditions.h"
#include "palpate/springs/step_bound.h"

namespace palpate::springs {
namespace {

SpringNetwork unfitted(const Eigen::VectorXd& places, double line_density) {
  const auto n = static_cast<int>(places.size());
  if (n < 3) throw std::invalid_argument("a line needs 3 masses or more");
  SpringNetwork line;
  line.points = Points::Zero(3, n);
  line.points.row(0) = places.transpose();
  line.masses = Eigen::VectorXd::Zero(n);
  for (int i = 0; i + 1 < n; ++i) {
    const double V = places[i + 1] - places[i];
    if (!(V > 0.0)) {
      throw std::invalid_argument("place " + std::to_string(i + 1) +
                                  " must be above the one before");
    }
    line.masses[i] += 0.5 * line_density * V;
    line.masses[i + 1] += 0.5 * line_density * V;
  }
  for (const int step : {1, 2}) {
    const SpringKind kind = step == 1 ? SpringKind::kStructural : SpringKind::kFlexion;
    for (int i = 0; i + step < n; ++i) {
      line.springs.push_back({i, i + step, 0.0, 0.0, 0.0, places[i + step] - places[i], kind});
    }
  }
  return line;
}

// Calls f(spring, length, direction away) for the springs of a mass.
template <class F>
void forEachAt(const SpringNetwork& line, int mass, const F& f) {
  for (std::size_t i = 0; i < line.springs.size(); ++i) {
    const Spring& s = line.springs[i];
    if (s.a == mass) f(static_cast<Eigen::Index>(i), s.length, 1.0);
    if (s.b == mass) f(static_cast<Eigen::Index>(i), s.length, -1.0);
  }
}

}  // namespace

LineFit fitLine(const BeamSection& beam, const Eigen::VectorXd& places, double line_density,
                const LineWeights& weights, const FitSettings& settings) {
  check(beam);
  requirePositive("line_density", line_density);
  LineFit fit;
  SpringNetwork& line = fit.network = unfitted(places, line_density);
  const auto count = static_cast<Eigen::Index>(line.springs.size());
  const double mean = (places[places.size() - 1] - places[0]) / double(places.size() - 1);

  Conditions soft(count), hard(count), stretch(count);
  const auto bending = soft.addFamily("bending", weights.bending),
             tension = soft.addFamily("no_tension", weights.no_tension);
  const auto balance = hard.addFamily("balance");
  const auto modulus = stretch.addFamily("stretch", weights.stretch),
             even = stretch.addFamily("evenness", weights.evenness);
  for (int m = 0; m < places.size(); ++m) {
    const double V = 2.0 * line.masses[m] / line_density;  // sum of both spacings
    const double B = 0.25 * beam.young_modulus * beam.second_moment * V;
    const double C = 0.25 * beam.young_modulus * beam.area * V;
    soft.begin(bending, 48.0 * B, -48.0 * B);
    forEachAt(line, m, [&](auto i, double U, double) { soft.add(i, U * U * U); });
    soft.begin(tension, 48.0 * B / (mean * mean));
    forEachAt(line, m, [&](auto i, double U, double) { soft.add(i, U); });
    hard.begin(balance, 48.0 * B / (mean * mean * mean));
    forEachAt(line, m, [&](auto i, double, double e) { hard.add(i, e); });
    stretch.begin(modulus, 4.0 * C, 4.0 * C);
    forEachAt(line, m, [&](auto i, double U, double) { stretch.add(i, U * U); });
    if (m == 0 || m == places.size() - 1) continue;
    stretch.begin(even, 4.0 * C / mean);
    forEachAt(line, m, [&](auto i, double U, double e) { stretch.add(i, U * e); });
  }
  Eigen::VectorXd P = equalityLeastSquares(soft.matrix(), soft.right(), hard.matrix());
  if (settings.match_mean) P *= soft.matchingFactor(bending, P);
  Eigen::VectorXd upper = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity());
  if (settings.explicit_step != 0.0) {
    upper = largestStiffness(line.springs, line.masses, settings.explicit_step);
  }
  Eigen::VectorXd k = boundedLeastSquares(stretch.matrix(), stretch.right(), upper).x;
  if (settings.match_mean) k = (stretch.matchingFactor(modulus, k) * k).cwiseMin(upper);
  for (Eigen::Index i = 0; i < count; ++i) {
    line.springs[static_cast<std::size_t>(i)].preload = P[i];
    line.springs[static_cast<std::size_t>(i)].stiffness = k[i];
  }
  fit.preload = hard.residuals(P);
  for (const ConstraintFamily& family : soft.residuals(P)) fit.preload.push_back(family);
  fit.stiffness = stretch.residuals(k);
  return fit;
}

}  // namespace palpate::springs
