// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <thread>

namespace palpate::node {

/// Cores for the simulation's steps, >= 1. One is left to the force loop, to ROS and to other
/// programs: threads that share their last core with these wait for each other for whole time
/// slices.
inline int stepCores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

}  // namespace palpate::node
