// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// How an explicit integrator takes velocities and positions forward by a step.
enum class ExplicitRule {
  kForwardEuler,    ///< Both from the old state [Wang 2005, (2.7), (2.8)].
  kSymplecticEuler  ///< Positions by the new velocities; as stable as central differences.
};

/// The largest stiffness M of each spring [N/m] for which an explicit step of `step` T [s] is
/// stable however the others are, up to their own bound: the k < M of [Wang 2005, (6.35), (7.60)].
/// With n springs at a mass m, and a drag of `drag` d times the velocity and mass [1/s],
///
///     M = w^2/(n_a/m_a + n_b/m_b),   w^2 = d/T  or  (4 - 2 T d)/T^2
///
/// for the two rules: no eigenvalue of a whole is above the largest of its parts [Irons, Treharne
/// 1971], of which each has a share of the masses. Preload counts like the stiffness where it is
/// above stiffness times length.
///
/// @throws std::invalid_argument for a step that is not > 0, a drag that is not in [0, 2/T), or 0
/// with forward Euler, which is then never stable.
Eigen::VectorXd largestStiffness(const std::vector<Spring>& springs, const Eigen::VectorXd& masses,
                                 double step, ExplicitRule rule = ExplicitRule::kSymplecticEuler,
                                 double drag = 0.0);

/// The longest step of symplectic Euler without drag for which a network is stable by the same rule
/// [s]: of the largest of stiffness and |preload|/length of each spring; infinite without springs.
double largestStep(const SpringNetwork& network);

}  // namespace palpate::springs
