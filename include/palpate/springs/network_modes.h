// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Small motions of a free network about its equilibrium.
struct NetworkModes {
  int falling;  ///< Number of modes with negative stiffness: the preload buckles the network.
  int neutral;  ///< Number of modes without stiffness: six rigid motions, the others mechanisms.
};

/// Counts eigenvalues of the tangent at rest below -1e-9 and within 1e-9 of its largest, by a dense
/// decomposition of cubic cost; some seconds for 500 points.
NetworkModes networkModes(const SpringNetwork& network);

}  // namespace palpate::springs
