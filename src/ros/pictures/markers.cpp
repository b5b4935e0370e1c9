// SPDX-License-Identifier: GPL-3.0-or-later
#include "markers.h"

#include "marker_parts.h"
#include "ros/messages/conversions.h"
#include "ros/messages/topics.h"

namespace palpate::node {

using visualization_msgs::Marker;

SceneMarkers::SceneMarkers(const sim::Simulator& simulator, double arrow_scale, double longest)
    : num_organs_(static_cast<std::size_t>(simulator.numOrgans())),
      num_contacts_(num_organs_ + (simulator.numAnatomy() > 0 ? 1 : 0)),
      num_instruments_(static_cast<std::size_t>(simulator.numInstruments())),
      arrow_scale_(arrow_scale),
      longest_(longest),
      shortest_(1e-3 * markerScale(simulator)) {
  const double scale = markerScale(simulator);
  for (std::size_t i = 0; i < num_organs_; ++i) {
    Marker m = marker(kOrganMarkers, i, Marker::TRIANGLE_LIST);
    m.scale.x = m.scale.y = m.scale.z = 1.0;
    m.color = organColour(simulator.organName(static_cast<int>(i)), i);
    message_.markers.push_back(m);
  }
  for (std::size_t i = 0; i < num_contacts_; ++i) {
    Marker m = marker(kContactMarkers, i, Marker::SPHERE_LIST);
    m.scale.x = m.scale.y = m.scale.z = 0.0035 * scale;
    m.color = colour(1.0F, 0.85F, 0.2F);
    message_.markers.push_back(m);
  }
  for (std::size_t i = 0; i < num_instruments_; ++i) {
    Marker m = marker(kWrenchMarkers, i, Marker::ARROW);
    m.scale.x = 0.004 * scale;  // shaft
    m.scale.y = 0.014 * scale;  // head, wider than the shafts of tools
    m.scale.z = 0.012 * scale;  // length of the head
    m.color = colour(0.15F, 0.85F, 0.45F);
    m.points.resize(2);
    message_.markers.push_back(m);
  }
}

const visualization_msgs::MarkerArray& SceneMarkers::update(const Picture& picture) {
  for (Marker& m : message_.markers) m.header.stamp = picture.stamp;
  for (std::size_t i = 0; i < num_organs_; ++i) updateOrgan(picture.organs[i], i);
  updateContacts(picture);
  fitArrows(picture);
  for (std::size_t i = 0; i < num_instruments_; ++i) updateArrow(picture, i);
  return message_;
}

// Triangles and positions are of one moment, so no index is beyond the points.
void SceneMarkers::updateOrgan(const SurfacePicture& picture, std::size_t organ) {
  if (!picture.positions.allFinite()) return;  // the last good surface stays
  Marker& m = message_.markers[organ];
  const Eigen::Matrix3Xi& triangles = *picture.triangles;
  m.action = triangles.size() > 0 ? Marker::ADD : Marker::DELETE;
  m.points.resize(static_cast<std::size_t>(triangles.size()));
  for (Eigen::Index k = 0; k < triangles.size(); ++k) {
    m.points[static_cast<std::size_t>(k)] = toPoint(picture.positions.col(triangles.data()[k]));
  }
}

// An empty list and an arrow of no length are errors to rviz: they are deleted instead.
void SceneMarkers::updateContacts(const Picture& picture) {
  const std::size_t first = num_organs_;
  for (std::size_t i = 0; i < num_contacts_; ++i) message_.markers[first + i].points.clear();
  for (const sim::ContactPoint& contact : picture.contacts) {
    if (!contact.p_W.allFinite()) continue;
    const bool of_organ = contact.organ != sim::ContactPoint::kNone;
    const std::size_t list = of_organ ? static_cast<std::size_t>(contact.organ) : num_organs_;
    message_.markers[first + list].points.push_back(toPoint(contact.p_W));
  }
  for (std::size_t i = 0; i < num_contacts_; ++i) {
    Marker& m = message_.markers[first + i];
    m.action = m.points.empty() ? Marker::DELETE : Marker::ADD;
  }
}

void SceneMarkers::fitArrows(const Picture& picture) {
  for (const Wrench& wrench : picture.spatial) {
    if (!wrench.allFinite()) continue;
    while (arrow_scale_ * wrench.force.norm() > longest_) arrow_scale_ *= 0.5;
  }
}

void SceneMarkers::updateArrow(const Picture& picture, std::size_t instrument) {
  Marker& m = message_.markers[num_organs_ + num_contacts_ + instrument];
  m.action = Marker::DELETE;
  if (instrument >= picture.spatial.size()) return;
  const Vec3 tail = picture.X_WC[instrument].translation();
  const Vec3 arrow = arrow_scale_ * picture.spatial[instrument].force;
  if (!tail.allFinite() || !arrow.allFinite() || arrow.norm() < shortest_) return;
  m.action = Marker::ADD;
  m.points[0] = toPoint(tail);
  m.points[1] = toPoint(tail + arrow);
}

}  // namespace palpate::node
