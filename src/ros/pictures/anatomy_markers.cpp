// SPDX-License-Identifier: GPL-3.0-or-later
#include "anatomy_markers.h"

#include "ros/messages/conversions.h"
#include "ros/messages/topics.h"

namespace palpate::node {

visualization_msgs::MarkerArray anatomyMarkers(const sim::Simulator& simulator) {
  visualization_msgs::MarkerArray message;
  for (int i = 0; i < simulator.numAnatomy(); ++i) {
    const mesh::SurfaceMesh surface = simulator.anatomySurface(i);
    visualization_msgs::Marker m;
    m.header.frame_id = kWorldFrame;
    m.ns = kAnatomyMarkers;
    m.id = i;
    m.type = visualization_msgs::Marker::TRIANGLE_LIST;
    m.action = visualization_msgs::Marker::ADD;
    m.pose.orientation.w = 1.0;
    m.scale.x = m.scale.y = m.scale.z = 1.0;
    m.color.r = 0.89F;  // bone
    m.color.g = 0.85F;
    m.color.b = 0.76F;
    m.color.a = 1.0F;
    for (const int corner : surface.triangles.reshaped()) {
      m.points.push_back(toPoint(surface.points.col(corner)));
    }
    message.markers.push_back(m);
  }
  return message;
}

}  // namespace palpate::node
