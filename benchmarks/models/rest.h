// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "palpate/springs/network_statics.h"

namespace palpate::models {

/// Moves the free components of x to equilibrium. @throws std::runtime_error if there is none.
inline void comeToRest(const springs::SpringNetwork& network, const springs::NetworkLoads& loads,
                       double imbalance, Points* x, int iteration_limit = 200) {
  const auto report = springs::solveNetwork(network, loads, {imbalance, iteration_limit}, x);
  if (report.status != solver::SolveStatus::kConverged) {
    throw std::runtime_error("no equilibrium: imbalance " + std::to_string(report.imbalance) +
                             " N after " + std::to_string(report.iterations) + " iterations");
  }
}

/// Nothing where the tangent has motions without energy, or loses some.
inline std::optional<Points> moveLinearly(const springs::SpringNetwork& network,
                                          const springs::NetworkLoads& loads) {
  return springs::linearDisplacements(network, network.points, loads,
                                      Points::Zero(3, network.points.cols()));
}

}  // namespace palpate::models
