// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "motion.h"

namespace palpate::node {

/// The inputs that were recorded in a bag, and nothing else of it: joint topics of the scene's
/// instruments, and of tf the transforms between the world and the links of instruments that come
/// by tf. Each message gets the stamp that it would have if its motion happened now.
class BagMotion : public Motion {
 public:
  /// The publishers must live as long.
  /// @throws InputError as openInputBag() and decodedMessage().
  BagMotion(const std::string& file, const scene::Scene& scene, InputPublishers* publishers);

  void rewind() override;
  std::optional<double> next() override;
  void send(double t, const PlayedTime& played) override;

 private:
  void findFrames(const scene::Scene& scene);
  bool isInput(const std::string& topic) const;
  double timeOf(const ros::Time& stamp) const;  // [s] from the beginning
  void sendTf(const rosbag::MessageInstance& message, const PlayedTime& played);

  std::string file_;
  InputPublishers& publishers_;
  rosbag::Bag bag_;
  std::set<std::string> topics_;  // of joints, absolute
  std::set<std::string> frames_;  // that are played; empty: no instrument comes by tf
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator message_;
};

}  // namespace palpate::node
