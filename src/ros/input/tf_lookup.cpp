// SPDX-License-Identifier: GPL-3.0-or-later
#include "tf_lookup.h"

#include <tf2/exceptions.h>

#include <algorithm>

#include "ros/messages/conversions.h"
#include "ros/messages/topics.h"

namespace palpate::node {

TfLookup::TfLookup(const instrument::Instrument& instrument, const scene::InstrumentConfig& config)
    : num_links_(instrument.linkNames().size()) {
  std::vector<int> needed = {instrument.linkIndex(config.control_frame)};
  for (const instrument::CollisionBody& body : instrument.bodies()) needed.push_back(body.link);
  for (const int i : needed) {
    const auto known = [i](const Link& link) { return link.index == i; };
    if (i < 0 || std::any_of(links_.begin(), links_.end(), known)) continue;
    links_.push_back({i, config.tf_prefix + instrument.linkNames()[static_cast<std::size_t>(i)]});
  }
}

std::string TfLookup::lookup(const tf2::BufferCore& buffer, sim::LinkPoses* poses,
                             ros::Time* stamp) const {
  std::vector<geometry_msgs::TransformStamped> found;
  found.reserve(links_.size());
  ros::Time common;
  try {
    for (const Link& link : links_) {
      found.push_back(buffer.lookupTransform(kWorldFrame, link.frame, ros::Time()));
      const ros::Time& t = found.back().header.stamp;
      if (!t.isZero()) common = common.isZero() ? t : std::min(common, t);
    }
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const ros::Time& t = found[i].header.stamp;
      if (!t.isZero() && t != common) {
        found[i] = buffer.lookupTransform(kWorldFrame, links_[i].frame, common);
      }
    }
  } catch (const tf2::TransformException& e) {
    return e.what();
  }
  poses->assign(num_links_, Pose::Identity());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    (*poses)[static_cast<std::size_t>(links_[i].index)] = toPose(found[i].transform);
  }
  *stamp = common;
  return "";
}

std::vector<std::string> TfLookup::frames() const {
  std::vector<std::string> names;
  for (const Link& link : links_) names.push_back(link.frame);
  return names;
}

}  // namespace palpate::node
