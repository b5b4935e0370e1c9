// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/step_bound.h"

#include <stdexcept>
#include <string>

#include "palpate/base/number.h"
#include "palpate/springs/continuum.h"

namespace palpate::springs {

Eigen::VectorXd largestStiffness(const std::vector<Spring>& springs, const Eigen::VectorXd& masses,
                                 double step, ExplicitRule rule, double drag) {
  requirePositive("step", step);
  const bool forward = rule == ExplicitRule::kForwardEuler;
  if (!(drag >= 0.0 && drag < 2.0 / step) || (forward && drag == 0.0)) {
    throw std::invalid_argument("drag = " + formatNumber(drag) + "; must be " +
                                (forward ? "> 0" : ">= 0") + " and < 2/step");
  }
  const double square = forward ? drag / step : (4.0 - 2.0 * step * drag) / (step * step);
  Eigen::VectorXd meeting = Eigen::VectorXd::Zero(masses.size());
  for (const Spring& s : springs) {
    meeting[s.a] += 1.0;
    meeting[s.b] += 1.0;
  }
  Eigen::VectorXd largest(static_cast<Eigen::Index>(springs.size()));
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const int a = springs[i].a, b = springs[i].b;
    largest[static_cast<Eigen::Index>(i)] =
        square / (meeting[a] / masses[a] + meeting[b] / masses[b]);
  }
  return largest;
}

}  // namespace palpate::springs
