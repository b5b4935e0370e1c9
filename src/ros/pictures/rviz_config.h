// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "view.h"

namespace palpate::node {

/// Names in the ROS graph that rviz listens to, all absolute.
struct RvizNames {
  struct Tool {
    std::string name, description, wrench;  ///< description: a parameter; wrench: a topic.
  };
  std::string organs, cutaway, anatomy, state;  ///< Topics.
  std::vector<Tool> tools;
};

/// The text of a configuration of rviz that shows the whole scene.
std::string rvizConfig(const View& view, const RvizNames& names);

}  // namespace palpate::node
