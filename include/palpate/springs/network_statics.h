// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "palpate/solver/status.h"
#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// What acts on the points of a network at rest. Both 3 x n.
struct NetworkLoads {
  Points forces;  ///< [N]
  Points free;    ///< 1 where a component may move, 0 where it is held.
};

/// Nothing acts, and every component is free.
NetworkLoads noLoads(const SpringNetwork& network);

/// Second derivative of the energy by the positions, at x (3 x n): 3n x 3n, symmetric [N/m]. With
/// preload it is not that of the lengths alone: a spring in tension resists to be turned.
Eigen::SparseMatrix<double> networkTangent(const SpringNetwork& network, const Points& x);

/// Displacements of the free components in linear equilibrium about x under the forces, where the
/// held ones are displaced by `prescribed` (3 x n; its free components are not read) [m]. The
/// forces of the springs at x are not counted. Nothing if the tangent is not positive definite: the
/// network is a mechanism, or buckles by itself.
std::optional<Points> linearDisplacements(const SpringNetwork& network, const Points& x,
                                          const NetworkLoads& loads, const Points& prescribed);

/// When an equilibrium is found.
struct NetworkStaticsSettings {
  double largest_imbalance;   ///< [N] a component
  int iteration_limit = 200;  ///< Newton iterations
};

struct NetworkStaticsReport {
  solver::SolveStatus status;
  int iterations;
  double imbalance;  ///< Largest unbalanced component [N].
};

/// Minimises energy - forces . x over the free components of x by Newton's method with line search
/// from where x is; where the tangent is not positive definite, a multiple of the identity is added
/// that makes it so. Held components stay where they are in x.
NetworkStaticsReport solveNetwork(const SpringNetwork& network, const NetworkLoads& loads,
                                  const NetworkStaticsSettings& settings, Points* x);

}  // namespace palpate::springs
