// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_guard: stands between the node and a haptic device, in a process of its own. It passes
// wrenches on as they come, within limits, and takes the last one back when none comes any more: a
// device holds what it heard last, also of a node that has died. Its parameters: --help.
#include <geometry_msgs/WrenchStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "ending.h"
#include "master_watch.h"
#include "palpate/base/error.h"
#include "palpate/haptics/silence_guard.h"
#include "palpate/scene/scene.h"
#include "ros/input/one_publisher.h"
#include "ros/messages/conversions.h"
#include "ros/messages/topics.h"
#include "ros/node/params.h"
#include "ros/program/param_fields.h"
#include "ros/program/program.h"
#include "ros/program/throttle.h"
#include "shipped.h"

namespace palpate::node {
namespace {

constexpr double kTick = 0.002;  // [s]
constexpr double kToEnd = 1.0;   // [s] from the last zero on

struct GuardParams {
  std::string scene, instrument, input, output;
  double patience = 0.05;  // [s]
  haptics::WrenchFilterSettings limits;

  GuardParams() { limits.ramp = 0.02; }
};

void describe(keys::FieldVisitor& v, GuardParams& p) {
  v.text({"input", "", "Topic of the node's wrench; or give scene."}, p.input);
  v.text({"scene", "", "The node's scene, in place of the topic."}, p.scene);
  v.text({"instrument", "", "Of the scene, whose wrench it is."}, p.instrument);
  v.rule(p.input.empty() != p.scene.empty(), "input",
         "must be a topic, or scene must be given, not both");
  v.text({"output", "", "Topic of the device's wrench."}, p.output);
  v.rule(!p.output.empty(), "output", "must be a topic");
  v.number({"patience", "s", "So long a silence is none yet."}, p.patience,
           keys::Range::closed(0.0));
  v.number({"ramp", "s", "From there to zero, and back."}, p.limits.ramp, keys::Range::closed(0.0));
  v.number({"max_force", "N", "A longer force is shortened to this."}, p.limits.max_force,
           keys::Range::above(0.0, 1000.0));
  v.number({"max_torque", "N m", "A longer torque is shortened to this."}, p.limits.max_torque,
           keys::Range::above(0.0, 1000.0));
  v.number({"max_force_rate", "N/s", "The force to the device changes no faster."},
           p.limits.max_force_rate, keys::Range::above(0.0, 1.0e6));
}

/// The topic of the wrench of the scene's instrument that is meant.
std::string inputOf(const GuardParams& p) {
  const scene::Scene scene = scene::readScene(start::sceneFile(p.scene));
  std::vector<std::string> names;
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    names.push_back(instrument.name);
  }
  const std::string of = "; those of " + scene.file + " are " + joinNames(names);
  if (p.instrument.empty()) {
    if (names.size() == 1) return instrumentTopic(names.front(), kBodyWrench);
    throw InputError("~instrument", "", "", "must name an instrument" + of);
  }
  if (std::find(names.begin(), names.end(), p.instrument) == names.end()) {
    throw InputError("~instrument", "", p.instrument, "must be an instrument of the scene" + of);
  }
  return instrumentTopic(p.instrument, kBodyWrench);
}

GuardParams readGuardParams(const ros::NodeHandle& handle) {
  GuardParams p;
  ParamFields fields(handle);
  fields.applyHere(p);
  fields.refuseOthers();
  fields.check();
  if (p.input.empty()) p.input = inputOf(p);
  p.limits.max_torque_rate = p.limits.max_force_rate * p.limits.max_torque / p.limits.max_force;
  return p;
}

About about() {
  About about;
  about.program = "palpate_guard";
  about.what =
      "Stands between the node and a haptic device. It passes wrenches on as they come, within\n"
      "limits, and takes the last one back when none comes any more, for a device holds what it\n"
      "heard last.";
  GuardParams defaults;
  about.params.applyHere(defaults);
  about.hears = {{"~input", "geometry_msgs/WrenchStamped",
                  "the node's wrench, of one publisher; or as ~scene says"}};
  about.says = {{"~output", "geometry_msgs/WrenchStamped", "the wrench for the device"}};
  return about;
}

/// One input, of one publisher, one output, one thread.
class Guard {
 public:
  Guard(ros::NodeHandle handle, const GuardParams& params)
      : guard_(params.patience, params.limits),
        publisher_(params.patience),
        output_(handle.advertise<geometry_msgs::WrenchStamped>(params.output, 1)),
        input_(handle.subscribe(params.input, 1, &Guard::receive, this,
                                ros::TransportHints().tcpNoDelay())) {}

  /// Until the end of the program is asked for, and the output is zero. From then on nothing is
  /// heard: callbacks are no longer called. To unsubscribe would ask the master, which may hang.
  void run() {
    while (!Ending::asked()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kTick));
      if (Steady::now() - last_ >= seconds(kTick)) pass();
    }
    do {
      std::this_thread::sleep_for(seconds(kTick));
      pass();
    } while (!guard_.silent() || guard_.output().force != Vec3::Zero() ||
             guard_.output().torque != Vec3::Zero());
    for (int k = 0; k < 20; ++k) {
      pass();
      std::this_thread::sleep_for(seconds(kTick));
    }
    Ending::limit(kToEnd, 0);  // a master that hangs would be waited for
  }

 private:
  double sinceLast() {
    const Steady::time_point before = last_;
    last_ = Steady::now();
    return inSeconds(last_ - before);
  }
  void receive(const ros::MessageEvent<const geometry_msgs::WrenchStamped>& event) {
    const bool counts =
        publisher_.takes(event.getConnectionHeaderPtr(), event.getPublisherName(), Steady::now());
    if (!counts && warning_.due()) {
      ROS_ERROR_STREAM(input_.getTopic() << ": " << publisher_.conflict(Steady::now()));
    }
    if (!counts) return;
    const geometry_msgs::WrenchStamped& message = *event.getConstMessage();
    const Wrench wrench = fromMsg(message.wrench);
    // What is no number is not heard, and may not hold up the silence that follows.
    if (!wrench.force.allFinite() || !wrench.torque.allFinite()) return;
    header_ = message.header;
    if (!guard_.hear(wrench, sinceLast())) return;
    if (spoken_for_) ROS_INFO("the wrench is back");
    spoken_for_ = false;
    send();
  }
  void pass() {
    if (!guard_.pass(sinceLast())) return;
    if (!spoken_for_ && !header_.frame_id.empty() && !Ending::asked()) {
      ROS_WARN("nothing is heard on %s: the wrench goes to zero", input_.getTopic().c_str());
    }
    spoken_for_ = true;
    header_.stamp = ros::Time::now();
    send();
  }
  void send() { output_.publish(toMsg(guard_.output(), header_.stamp, header_.frame_id)); }

  haptics::SilenceGuard guard_;
  OnePublisher publisher_;
  std_msgs::Header header_;  // of what was heard last
  Steady::time_point last_ = Steady::now();
  bool spoken_for_ = false;
  Throttle warning_{5.0};
  ros::Publisher output_;
  ros::Subscriber input_;
};

}  // namespace
}  // namespace palpate::node

int main(int argc, char** argv) {
  using namespace palpate::node;
  return runProgram(argc, argv, "palpate_guard", about(), [](bool) {
    Guard guard(ros::NodeHandle(), readGuardParams(ros::NodeHandle("~")));
    MasterWatch master({});
    master.start();
    guard.run();
    return 0;
  });
}
