// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <visualization_msgs/Marker.h>

#include <string>
#include <vector>

#include "ros/messages/channels.h"
#include "view.h"

namespace palpate::node {

/// Says above the organs why there is no force, or that meshes are coarser than asked for:
/// namespace "state", a TEXT_VIEW_FACING in world that is deleted while all runs as asked.
class StateText {
 public:
  /// `names` and `sources` of the instruments, see Input::source().
  StateText(const View& view, const std::vector<std::string>& names,
            const std::vector<std::string>& sources);

  /// Whether the text has become another one since the last call; true in the first. `coarsening`:
  /// present factor of adapt.finest [-].
  bool update(NodeState state, const std::vector<ToolState>& tools, double coarsening = 1.0);
  const visualization_msgs::Marker& marker() const { return marker_; }

 private:
  std::vector<std::string> names_, sources_;
  visualization_msgs::Marker marker_;
  bool said_ = false;
};

}  // namespace palpate::node
