// SPDX-License-Identifier: GPL-3.0-or-later
// What palpate_replay_bag does with a bag, up to the simulation.
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/replay/bag_inputs.h"
#include "scratch_file.h"
#include "state_scenes.h"
#include "targets.h"

namespace palpate::fuzz {
namespace {

constexpr char kJoints[] = "/probe/measured_js";

/// A block under two probes, one moved by its joint, the other by tf.
const sim::Simulator& twoProbes() {
  static const std::unique_ptr<sim::Simulator> simulator = makeBlock(
      "", "  - {name: tracked, urdf: probe.urdf, control_frame: tip, input: tf, tf_prefix: t_}\n");
  return *simulator;
}

void readBag(std::string_view bytes) {
  static const ScratchFile file("hostile.bag");
  node::BagInputs inputs(file.write(bytes), twoProbes());
  bool started = false;
  ros::Time first;
  inputs.walk([](const rosbag::MessageInstance&, const ros::Time&) {},
              [&](const node::BagCycle& cycle) {
                if (!started) first = cycle.stamp;
                started = true;
                require(std::isfinite(node::bagTime(cycle.stamp, first)), "a time of NaN");
                for (const sim::LinkPoses& links : cycle.poses) {
                  for (const Pose& X : links) {
                    require(X.matrix().allFinite(), "a link that is nowhere");
                  }
                }
              });
}

std::string bagOf(rosbag::CompressionType compression) {
  const ScratchFile file("well.bag");
  rosbag::Bag bag;
  bag.open(file.path(), rosbag::bagmode::Write);
  bag.setCompression(compression);
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "world";
  transform.child_frame_id = "t_tip";
  transform.transform.rotation.w = 1.0;
  for (int k = 1; k <= 3; ++k) {
    const ros::Time stamp(k, 0);
    sensor_msgs::JointState joints;
    joints.header.stamp = transform.header.stamp = stamp;
    joints.name = {"z"};
    joints.position = {0.01 * k};
    tf2_msgs::TFMessage tf;
    tf.transforms = {transform};
    bag.write(kJoints, stamp, joints);
    bag.write(k == 1 ? "/tf_static" : "/tf", stamp, tf);
  }
  bag.close();
  return test::fileBytes(file.path());
}

std::vector<std::string> bags() {
  return {bagOf(rosbag::compression::Uncompressed), bagOf(rosbag::compression::BZ2),
          bagOf(rosbag::compression::LZ4)};
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {{"bag", readBag, bags, 256.0, std::size_t{16} << 20}};
  return all;
}

}  // namespace palpate::fuzz
