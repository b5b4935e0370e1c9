// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Small motions of a free network about its points, where it is in balance.
struct NetworkModes {
  int falling;  ///< That lose energy: preload buckles the network by itself.
  int neutral;  ///< Without any: six rigid motions, the others are mechanisms.
};

/// Counts eigenvalues of the tangent at rest that are below -1e-9 and within 1e-9 of its largest,
/// by a dense decomposition: time grows with the cube of the points, some seconds for 500.
NetworkModes networkModes(const SpringNetwork& network);

}  // namespace palpate::springs
