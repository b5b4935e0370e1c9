// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <limits>
#include <string>
#include <vector>

#include "palpate/sim/simulator.h"
#include "ros/messages/channels.h"

namespace palpate::node {

/// Builds the MarkerArray of a picture, in world:
///  - namespace "organs", id = organ: lit TRIANGLE_LIST of one colour; as many triangles as before
///    unless the surface has become another one, so that rviz reuses its buffers;
///  - namespace "contacts", id = organ: the touching points (SPHERE_LIST); after the last organ
///  those
///    of tools on the anatomy, where there is any;
///  - namespace "wrench", id = instrument: the force as an arrow from the control frame.
/// Contacts and arrows are thinner where all organs are small.
/// Keeps the message between calls, so that nothing is allocated twice.
class SceneMarkers {
 public:
  /// `arrow_scale` [m/N] is halved, for good, where an arrow would be longer than `longest` [m].
  SceneMarkers(const sim::Simulator& simulator, double arrow_scale,
               double longest = std::numeric_limits<double>::infinity());

  const visualization_msgs::MarkerArray& update(const Picture& picture);

 private:
  void updateOrgan(const SurfacePicture& picture, std::size_t organ);
  void updateContacts(const Picture& picture);
  void fitArrows(const Picture& picture);
  void updateArrow(const Picture& picture, std::size_t instrument);

  std::size_t num_organs_, num_contacts_, num_instruments_;
  double arrow_scale_, longest_;
  double shortest_;                          // arrow that is shown [m]
  visualization_msgs::MarkerArray message_;  // organs, contacts, arrows
};

}  // namespace palpate::node
