// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Explicit update of velocities and positions.
enum class ExplicitRule {
  kForwardEuler,    ///< Both from the old state [Wang 2005, (2.7), (2.8)].
  kSymplecticEuler  ///< Positions by the new velocities; stability of central differences.
};

/// The largest stiffness M of each spring [N/m] for which an explicit step of `step` T [s] is
/// stable for all other springs within their bounds: the k < M of [Wang 2005, (6.35), (7.60)]. With
/// n springs at a mass m, and a drag of `drag` d times the velocity and mass [1/s],
///
///     M = w^2/(n_a/m_a + n_b/m_b),   w^2 = d/T  or  (4 - 2 T d)/T^2
///
/// for the two rules. The largest eigenvalue of the whole is at most that of its parts, each with a
/// share of the masses [Irons, Treharne 1971]. A preload above stiffness times length counts
/// instead of the stiffness.
///
/// @throws std::invalid_argument for a step not > 0, a drag not in [0, 2/T), or 0 with forward
/// Euler, which then is always unstable.
Eigen::VectorXd largestStiffness(const std::vector<Spring>& springs, const Eigen::VectorXd& masses,
                                 double step, ExplicitRule rule = ExplicitRule::kSymplecticEuler,
                                 double drag = 0.0);

/// Longest stable step [s] of symplectic Euler without drag, by the same rule with the larger of
/// stiffness and |preload|/length of each spring; infinite without springs.
double largestStep(const SpringNetwork& network);

}  // namespace palpate::springs
