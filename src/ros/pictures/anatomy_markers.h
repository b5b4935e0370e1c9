// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "palpate/sim/simulator.h"

namespace palpate::node {

/// The anatomy in world: namespace "anatomy", id = its number, a TRIANGLE_LIST each. It never
/// changes: sent once, on a topic that keeps it for who comes later.
visualization_msgs::MarkerArray anatomyMarkers(const sim::Simulator& simulator);

}  // namespace palpate::node
