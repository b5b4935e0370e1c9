// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/time.h>

#include <cstdint>

namespace palpate::node {

/// From one stamp to another [s], whatever stands in them: ROS's own difference throws where it
/// has more than 31 bits of seconds.
inline double secondsBetween(const ros::Time& from, const ros::Time& to) {
  const auto difference = static_cast<std::int64_t>(to.toNSec() - from.toNSec());
  return 1e-9 * static_cast<double>(difference);
}

}  // namespace palpate::node
