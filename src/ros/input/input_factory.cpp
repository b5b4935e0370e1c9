// SPDX-License-Identifier: GPL-3.0-or-later
#include "input_factory.h"

#include <tf2_ros/static_transform_broadcaster.h>

#include <vector>

#include "joint_input.h"
#include "ros/messages/conversions.h"
#include "ros/messages/topics.h"
#include "tf_input.h"
#include "tool_frames.h"

namespace palpate::node {

namespace {

// The frames of all links that come by tf.
std::vector<std::string> tfFrames(const sim::Simulator& simulator) {
  std::vector<std::string> frames;
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    const scene::InstrumentConfig& config =
        simulator.scene().instruments[static_cast<std::size_t>(i)];
    if (config.input != "tf") continue;
    for (const std::string& frame : TfLookup(simulator.instrument(i), config).frames()) {
      frames.push_back(frame);
    }
  }
  return frames;
}

}  // namespace

struct InputFactory::Tf {
  Tf(const ros::NodeHandle& handle, const sim::Simulator& simulator)
      : listener(handle, tfFrames(simulator), simulator.scene().rates.stale_after, &buffer) {}

  tf2::BufferCore buffer;
  TfListener listener;
};

InputFactory::InputFactory() = default;
InputFactory::~InputFactory() = default;

Inputs InputFactory::make(ros::NodeHandle handle, const sim::Simulator& simulator,
                          Channels* channels) {
  Inputs inputs;
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    const scene::InstrumentConfig& config =
        simulator.scene().instruments[static_cast<std::size_t>(i)];
    if (config.input == "tf") {
      LatestValue<HandPose>* const hand = &channels->hands[static_cast<std::size_t>(i)];
      if (!tf_) tf_ = std::make_unique<Tf>(handle, simulator);
      inputs.push_back(std::make_unique<TfInput>(tf_->buffer, &tf_->listener, simulator, i, hand));
    } else {
      inputs.push_back(std::make_unique<JointInput>(handle, jointTopic(config), config.name,
                                                    simulator, i, channels));
    }
  }
  return inputs;
}

void broadcastBases(const sim::Simulator& simulator) {
  std::vector<geometry_msgs::TransformStamped> bases;
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    const scene::InstrumentConfig& config =
        simulator.scene().instruments[static_cast<std::size_t>(i)];
    const std::string root = rootFrame(simulator, i);
    if (config.input != "joints" || root == kWorldFrame) continue;
    bases.push_back(toMsg(config.base.pose(), kWorldFrame, root, ros::Time::now()));
  }
  if (bases.empty()) return;
  static tf2_ros::StaticTransformBroadcaster broadcaster;  // latched: lives as long as the node
  broadcaster.sendTransform(bases);
}

}  // namespace palpate::node
