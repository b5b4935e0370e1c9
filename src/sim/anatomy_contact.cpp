// SPDX-License-Identifier: GPL-3.0-or-later
#include "anatomy_contact.h"

#include <algorithm>

#include "palpate/contact/signed_distance.h"

namespace palpate::sim {

AnatomyContact::AnatomyContact(const scene::SceneParts& parts) {
  if (parts.anatomy.empty()) return;
  std::size_t most = 0;  // balls of an instrument
  for (const instrument::Instrument& tool : parts.instruments) {
    std::vector<Shape>& shapes = shapes_.emplace_back();
    std::size_t count = 0;
    for (const instrument::CollisionBody& body : tool.bodies()) {
      shapes.push_back({static_cast<std::size_t>(body.link), body.X_LG,
                        contact::touchBalls(body.geometry),
                        contact::boundingRadius(body.geometry)});
      count += shapes.back().balls.size();
    }
    most = std::max(most, count);
  }
  for (const scene::AnatomyPart& part : parts.anatomy) {
    contacts_.emplace_back(&part.geometry, part.X_WG, part.stiffness);
    contacts_.back().reserve(most);
  }
}

void AnatomyContact::press(const std::vector<LinkPoses>& poses, StepResult* result) {
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (poses[i].empty()) continue;
    InstrumentResult& tool = result->instruments[i];
    for (std::size_t a = 0; a < contacts_.size(); ++a) {
      contact::RigidContact& contact = contacts_[a];
      contact.clear();
      for (const Shape& shape : shapes_[i]) {
        contact.add(shape.balls, shape.bounding_radius, poses[i][shape.link] * shape.X_LG);
      }
      contact.solve();
      for (const contact::RigidTouch& touch : contact.touches()) {
        const Vec3 arm = touch.p_W - tool.X_WC.translation();
        tool.spatial += Wrench{touch.force_W, arm.cross(touch.force_W)};
        ++tool.contacts;
        ContactPoint point;
        point.instrument = static_cast<int>(i);
        point.anatomy = static_cast<int>(a);
        point.p_W = touch.p_W;
        point.force_W = touch.force_W;
        result->contacts.push_back(point);
      }
    }
  }
}

bool AnatomyContact::isFree(std::size_t i, const LinkPoses& links) const {
  if (shapes_.empty()) return true;
  for (const contact::RigidContact& contact : contacts_) {
    for (const Shape& shape : shapes_[i]) {
      if (contact.wouldTouch(shape.balls, shape.bounding_radius, links[shape.link] * shape.X_LG)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace palpate::sim
