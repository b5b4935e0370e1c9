// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "palpate/solver/status.h"
#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Loads and supports of a network at rest, both 3 x n.
struct NetworkLoads {
  Points forces;  ///< [N]
  Points free;    ///< 1 for free, 0 for held components.
};

/// No forces, all components free.
NetworkLoads noLoads(const SpringNetwork& network);

/// Second derivative of the energy by the positions at x (3 x n): 3n x 3n, symmetric [N/m].
/// Includes the geometric stiffness of preloads: springs in tension resist rotation.
Eigen::SparseMatrix<double> networkTangent(const SpringNetwork& network, const Points& x);

/// Linear equilibrium displacements about x under the forces, with held components displaced by
/// `prescribed` (3 x n, free components ignored) [m]. Spring forces at x are not counted. Empty if
/// the tangent is not positive definite: the network is a mechanism, or buckles.
std::optional<Points> linearDisplacements(const SpringNetwork& network, const Points& x,
                                          const NetworkLoads& loads, const Points& prescribed);

/// Convergence criteria of an equilibrium.
struct NetworkStaticsSettings {
  double largest_imbalance;   ///< [N] per component
  int iteration_limit = 200;  ///< Newton iterations
};

struct NetworkStaticsReport {
  solver::SolveStatus status;
  int iterations;
  double imbalance;  ///< Largest unbalanced component [N].
};

/// Minimises energy - forces . x over the free components of x by Newton's method with line search,
/// from x. An indefinite tangent is shifted by a multiple of the identity. Held components of x
/// stay.
NetworkStaticsReport solveNetwork(const SpringNetwork& network, const NetworkLoads& loads,
                                  const NetworkStaticsSettings& settings, Points* x);

}  // namespace palpate::springs
