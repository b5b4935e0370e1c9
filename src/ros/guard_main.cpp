// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_guard: stands between the node and a haptic device, in a process of its own. It passes
// wrenches on as they come, and takes the last one back when none comes any more: a device holds
// what it heard last, also of a node that has died.
//
//   ~input    geometry_msgs/WrenchStamped, of the node
//   ~output   geometry_msgs/WrenchStamped, to the device
//   ~patience [s] so long a silence is none yet, 0.05
//   ~ramp     [s] from there to zero, 0.02
#include <geometry_msgs/WrenchStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <string>
#include <thread>

#include "conversions.h"
#include "ending.h"
#include "palpate/haptics/silence_guard.h"
#include "param_fields.h"
#include "program.h"
#include "throttle.h"

namespace palpate::node {
namespace {

constexpr double kTick = 0.002;  // [s]

struct GuardParams {
  std::string input, output;
  double patience = 0.05, ramp = 0.02;  // [s]
};

void describe(keys::FieldVisitor& v, GuardParams& p) {
  v.text({"input", "", "Topic of the node's wrench."}, p.input);
  v.rule(!p.input.empty(), "input", "must be a topic");
  v.text({"output", "", "Topic of the device's wrench."}, p.output);
  v.rule(!p.output.empty(), "output", "must be a topic");
  v.number({"patience", "s", "So long a silence is none yet."}, p.patience,
           keys::Range::closed(0.0));
  v.number({"ramp", "s", "From there to zero."}, p.ramp, keys::Range::closed(0.0));
}

GuardParams readGuardParams(const ros::NodeHandle& handle) {
  GuardParams p;
  ParamFields fields(handle);
  fields.applyHere(p);
  fields.refuseOthers();
  fields.check();
  return p;
}

/// One input, one output, one thread.
class Guard {
 public:
  Guard(ros::NodeHandle handle, const GuardParams& params)
      : guard_(params.patience, params.ramp),
        output_(handle.advertise<geometry_msgs::WrenchStamped>(params.output, 1)),
        input_(handle.subscribe(params.input, 1, &Guard::receive, this,
                                ros::TransportHints().tcpNoDelay())) {}

  /// Until the end of the program is asked for, and the output is zero.
  void run() {
    Steady::time_point last = Steady::now();
    while (!Ending::asked()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kTick));
      const Steady::time_point now = Steady::now();
      if (now - last < seconds(kTick)) continue;
      pass(inSeconds(now - last));
      last = now;
    }
    input_.shutdown();
    do {
      std::this_thread::sleep_for(seconds(kTick));
      pass(kTick);
    } while (!guard_.silent() || guard_.output().force != Vec3::Zero());
    for (int k = 0; k < 20; ++k) {
      pass(kTick);
      std::this_thread::sleep_for(seconds(kTick));
    }
  }

 private:
  void receive(const geometry_msgs::WrenchStamped& message) {
    last_ = message;
    if (!guard_.hear(fromMsg(message.wrench))) return;
    if (spoken_for_) ROS_INFO("the wrench is back");
    spoken_for_ = false;
    output_.publish(message);
  }
  void pass(double dt) {
    if (!guard_.pass(dt)) return;
    if (!spoken_for_ && !last_.header.frame_id.empty() && !Ending::asked()) {
      ROS_WARN("nothing is heard on %s: the wrench goes to zero", input_.getTopic().c_str());
    }
    spoken_for_ = true;
    last_.header.stamp = ros::Time::now();
    output_.publish(toMsg(guard_.output(), last_.header.stamp, last_.header.frame_id));
  }

  haptics::SilenceGuard guard_;
  geometry_msgs::WrenchStamped last_;
  bool spoken_for_ = false;
  ros::Publisher output_;
  ros::Subscriber input_;
};

}  // namespace
}  // namespace palpate::node

int main(int argc, char** argv) {
  return palpate::node::runProgram(argc, argv, "palpate_guard", [](bool) {
    palpate::node::Guard(ros::NodeHandle(), palpate::node::readGuardParams(ros::NodeHandle("~")))
        .run();
    return 0;
  });
}
