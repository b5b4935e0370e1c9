// SPDX-License-Identifier: GPL-3.0-or-later
#include "cutaway_markers.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "marker_parts.h"
#include "ros/messages/conversions.h"
#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

using visualization_msgs::Marker;

constexpr double kNode = 0.16;  // diameter of a point, of the mean edge

// Of the first solid its organ's.
std_msgs::ColorRGBA solidColour(const std_msgs::ColorRGBA& organ, int solid) {
  static const std::array<std_msgs::ColorRGBA, 5> kOthers = {
      colour(0.93F, 0.78F, 0.40F), colour(0.62F, 0.30F, 0.34F), colour(0.52F, 0.66F, 0.60F),
      colour(0.60F, 0.52F, 0.72F), colour(0.86F, 0.84F, 0.78F)};
  return solid == 0 ? organ : kOthers[static_cast<std::size_t>(solid - 1) % kOthers.size()];
}

std_msgs::ColorRGBA lighter(const std_msgs::ColorRGBA& c) {
  constexpr float kWhite = 0.3F;
  const auto mix = [&](float x) { return x + kWhite * (1.0F - x); };
  return colour(mix(c.r), mix(c.g), mix(c.b));
}

// rviz lights no triangles that have colours of their own.
std_msgs::ColorRGBA lit(const std_msgs::ColorRGBA& c, const Vec3& area) {
  static const Vec3 kLight = Vec3(0.4, -0.5, 0.77).normalized();  // from above, aside
  constexpr double kShade = 0.35;
  const double size = area.norm();
  const double facing = size > 0.0 ? kLight.dot(area) / size : 0.0;
  const auto bright = static_cast<float>(1.0 - kShade + kShade * facing);
  return colour(bright * c.r, bright * c.g, bright * c.b);
}

mesh::CutBox boxOf(const CutawayConfig& config, const Vec3& at) {
  mesh::CutBox box;
  for (int c = 0; c < 3; ++c) {
    if (config.corner[c] > 0) box.low[c] = at[c];
    if (config.corner[c] < 0) box.high[c] = at[c];
    if (config.size[c] == 0.0) continue;
    if (config.corner[c] > 0) box.high[c] = at[c] + config.size[c];
    if (config.corner[c] < 0) box.low[c] = at[c] - config.size[c];
  }
  return box;
}

}  // namespace

void describe(keys::FieldVisitor& v, CutawayConfig& cutaway) {
  v.integers3({"corner", "",
               "What is taken away, along each axis of the organ's frame: 1 beyond `at`, -1 before "
               "it, 0 all."},
              cutaway.corner, keys::Range::closed(-1.0, 1.0));
  cutaway.has_place =
      v.vector3({"at", "m", "Where the corner is; unless set, the middle of each organ."},
                cutaway.at, keys::coordinateRange());
  v.vector3({"size", "m", "Of what is taken away, along each axis; 0: to the organ's end."},
            cutaway.size, keys::Range::closed(0.0, 100.0));
  v.number({"rate", "Hz", "Pictures published in a second, at most."}, cutaway.rate,
           keys::Range::above(0.0, 1000.0));
  v.rule(!cutaway.corner.isZero(), "corner", "takes all away; let one axis be 1 or -1");
}

CutawayMarkers::CutawayMarkers(const sim::Simulator& simulator, const CutawayConfig& config)
    : config_(config) {
  const auto num_organs = static_cast<std::size_t>(simulator.numOrgans());
  for (std::size_t i = 0; i < num_organs; ++i) {
    Organ organ;
    organ.X_OW = simulator.scene().organs[i].pose.pose().inverse();
    organ.colour = organColour(simulator.organName(static_cast<int>(i)), i);
    organs_.push_back(organ);
    message_.markers.push_back(marker(kCutMarkers, i, Marker::TRIANGLE_LIST));
    Marker& m = message_.markers.back();
    m.color = organ.colour;
    m.scale.x = m.scale.y = m.scale.z = 1.0;
  }
  for (std::size_t i = 0; i < num_organs; ++i) {
    message_.markers.push_back(marker(kNodeMarkers, i, Marker::SPHERE_LIST));
    message_.markers.back().color = colour(0.90F, 0.10F, 0.10F);
  }
}

const visualization_msgs::MarkerArray& CutawayMarkers::update(const Picture& picture) {
  for (Marker& m : message_.markers) m.header.stamp = picture.stamp;
  for (std::size_t i = 0; i < organs_.size() && i < picture.organs.size(); ++i) {
    if (!picture.organs[i].cells) continue;
    if (organs_[i].cells != picture.organs[i].cells) {
      organs_[i].cells = picture.organs[i].cells;
      cut(i);
    }
    updateOrgan(picture.organs[i], i);
  }
  return message_;
}

void CutawayMarkers::cut(std::size_t i) {
  Organ& organ = organs_[i];
  mesh::CellMesh body = *organ.cells;
  body.points = (organ.X_OW * body.points.colwise().homogeneous()).eval();
  if (!organ.placed && body.points.cols() > 0) {
    const Vec3 middle = 0.5 * (body.points.rowwise().minCoeff() + body.points.rowwise().maxCoeff());
    organ.box = boxOf(config_, config_.has_place ? config_.at : middle);
    organ.placed = true;
  }
  organ.cut = mesh::cutAway(body, organ.box);
  organ.colours.clear();
  for (Eigen::Index t = 0; t < organ.cut.numTriangles(); ++t) {
    const std_msgs::ColorRGBA c =
        solidColour(organ.colour, organ.cut.solid[static_cast<std::size_t>(t)]);
    organ.colours.push_back(t < organ.cut.num_outer ? c : lighter(c));
  }
  Marker& nodes = message_.markers[organs_.size() + i];
  nodes.scale.x = nodes.scale.y = nodes.scale.z = kNode * mesh::meanEdgeLength(body);
}

void CutawayMarkers::updateOrgan(const SurfacePicture& picture, std::size_t i) {
  if (!picture.positions.allFinite()) return;  // the last good one stays
  Organ& organ = organs_[i];
  organ.cut.interpolate(picture.positions, &organ.vertices);
  Marker& m = message_.markers[i];
  m.points.resize(static_cast<std::size_t>(organ.vertices.cols()));
  for (std::size_t k = 0; k < m.points.size(); ++k) {
    m.points[k] = toPoint(organ.vertices.col(static_cast<Eigen::Index>(k)));
  }
  m.colors.resize(m.points.size());
  for (std::size_t t = 0; t < organ.colours.size(); ++t) {
    const Mat3 x = organ.vertices.middleCols<3>(3 * static_cast<Eigen::Index>(t));
    const Vec3 area = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
    std::fill_n(m.colors.begin() + 3 * static_cast<std::ptrdiff_t>(t), 3,
                lit(organ.colours[t], area));
  }
  m.action = m.points.empty() ? Marker::DELETE : Marker::ADD;
  Marker& nodes = message_.markers[organs_.size() + i];
  nodes.points.resize(organ.cut.bared.size());
  for (std::size_t k = 0; k < nodes.points.size(); ++k) {
    nodes.points[k] = toPoint(picture.positions.col(organ.cut.bared[k]));
  }
  nodes.action = nodes.points.empty() ? Marker::DELETE : Marker::ADD;
}

}  // namespace palpate::node
