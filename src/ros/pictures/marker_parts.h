// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <visualization_msgs/Marker.h>

#include <string>

#include "palpate/sim/simulator.h"

namespace palpate::node {

/// Opaque: anything less makes rviz sort triangles.
std_msgs::ColorRGBA colour(float r, float g, float b);

/// By the name of an organ, or else by its number.
std_msgs::ColorRGBA organColour(const std::string& name, std::size_t index);

/// In world, to be deleted until it has something to show.
visualization_msgs::Marker marker(const char* ns, std::size_t id, int type);

/// What markers of a fixed size are made smaller by, where all organs are small: 1 from 5 cm on.
double markerScale(const sim::Simulator& simulator);

}  // namespace palpate::node
