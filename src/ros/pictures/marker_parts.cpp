// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker_parts.h"

#include <algorithm>
#include <array>

#include "ros/messages/topics.h"

namespace palpate::node {

using visualization_msgs::Marker;

std_msgs::ColorRGBA colour(float r, float g, float b) {
  std_msgs::ColorRGBA c;
  c.r = r;
  c.g = g;
  c.b = b;
  c.a = 1.0F;
  return c;
}

std_msgs::ColorRGBA organColour(const std::string& name, std::size_t index) {
  const auto is = [&](const char* word) { return name.find(word) != std::string::npos; };
  if (is("liver")) return colour(0.66F, 0.26F, 0.20F);
  if (is("kidney")) return colour(0.63F, 0.27F, 0.24F);
  if (is("gall")) return colour(0.33F, 0.47F, 0.22F);
  if (is("spleen")) return colour(0.45F, 0.16F, 0.26F);
  static const std::array<std_msgs::ColorRGBA, 4> kOthers = {
      colour(0.80F, 0.55F, 0.47F), colour(0.78F, 0.64F, 0.42F), colour(0.55F, 0.48F, 0.60F),
      colour(0.47F, 0.58F, 0.62F)};
  return kOthers[index % kOthers.size()];
}

Marker marker(const char* ns, std::size_t id, int type) {
  Marker m;
  m.header.frame_id = kWorldFrame;
  m.ns = ns;
  m.id = static_cast<int>(id);
  m.type = type;
  m.action = Marker::DELETE;
  m.pose.orientation.w = 1.0;
  return m;
}

double markerScale(const sim::Simulator& simulator) {
  constexpr double kMeantFor = 0.1, kSmall = 0.05;  // [m]
  double widest = 0.0;
  for (int i = 0; i < simulator.numOrgans(); ++i) {
    const Points& x = simulator.positions(i);
    if (x.cols() == 0) continue;
    widest = std::max(widest, (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff());
  }
  return widest > 0.0 && widest < kSmall ? widest / kMeantFor : 1.0;
}

}  // namespace palpate::node
