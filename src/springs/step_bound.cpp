// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/step_bound.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/base/number.h"
#include "palpate/springs/continuum.h"

namespace palpate::springs {

namespace {

// n_a/m_a + n_b/m_b of each spring [1/kg].
Eigen::VectorXd inverseShares(const std::vector<Spring>& springs, const Eigen::VectorXd& masses) {
  Eigen::VectorXd meeting = Eigen::VectorXd::Zero(masses.size());
  for (const Spring& s : springs) {
    meeting[s.a] += 1.0;
    meeting[s.b] += 1.0;
  }
  Eigen::VectorXd shares(static_cast<Eigen::Index>(springs.size()));
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const int a = springs[i].a, b = springs[i].b;
    shares[static_cast<Eigen::Index>(i)] = meeting[a] / masses[a] + meeting[b] / masses[b];
  }
  return shares;
}

}  // namespace

Eigen::VectorXd largestStiffness(const std::vector<Spring>& springs, const Eigen::VectorXd& masses,
                                 double step, ExplicitRule rule, double drag) {
  requirePositive("step", step);
  const bool forward = rule == ExplicitRule::kForwardEuler;
  if (!(drag >= 0.0 && drag < 2.0 / step) || (forward && drag == 0.0)) {
    throw std::invalid_argument("drag = " + formatNumber(drag) + "; must be " +
                                (forward ? "> 0" : ">= 0") + " and < 2/step");
  }
  const double square = forward ? drag / step : (4.0 - 2.0 * step * drag) / (step * step);
  return square * inverseShares(springs, masses).cwiseInverse();
}

double largestStep(const SpringNetwork& network) {
  const Eigen::VectorXd shares = inverseShares(network.springs, network.masses);
  double square = 0.0;  // of the largest frequency
  for (std::size_t i = 0; i < network.springs.size(); ++i) {
    const Spring& s = network.springs[i];
    square = std::max(square, std::max(s.stiffness, std::abs(s.preload) / s.length) *
                                  shares[static_cast<Eigen::Index>(i)]);
  }
  return 2.0 / std::sqrt(square);
}

}  // namespace palpate::springs
