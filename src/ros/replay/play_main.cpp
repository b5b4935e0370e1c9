// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_play: moves the instruments of a palpate_node as a recorded motion says, in real time,
// and ends with the motion. Its parameters: --help.
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bag_motion.h"
#include "palpate/base/error.h"
#include "ros/guard/ending.h"
#include "ros/messages/topics.h"
#include "ros/node/node_scene.h"
#include "ros/program/param_fields.h"
#include "ros/program/program.h"
#include "ros/program/throttle.h"
#include "shipped.h"
#include "trajectory_motion.h"

namespace palpate::node {
namespace {

constexpr double kLook = 0.02;      // [s] between two looks whether something is there
constexpr double kToConnect = 5.0;  // [s] for the node to listen
constexpr double kBefore = 0.5;     // [s] for others, such as who records
constexpr double kAfter = 0.3;      // [s] for what comes of the last message

struct PlayParams {
  NodeSceneParams of;
  std::string trajectory;
  double rate = 1.0, publish_rate = 500.0;
  bool loop = false;
};

void describe(keys::FieldVisitor& v, PlayParams& p) {
  describe(v, p.of);
  v.text(
      {"trajectory", "",
       "A table of joint positions (.csv), as palpate replay takes it, or a bag of the inputs; if "
       "not given, that which comes with a shipped scene."},
      p.trajectory);
  v.number({"rate", "", "Seconds of the motion in a second."}, p.rate, keys::Range::above(0.0));
  v.number({"publish_rate", "Hz", "Messages of a table in a second: as many as an arm sends."},
           p.publish_rate, keys::Range::above(0.0));
  v.flag({"loop", "", "Again and again, each time with the organs at rest."}, p.loop);
}

About about() {
  About about;
  about.program = "palpate_play";
  about.what =
      "Moves the instruments of a palpate_node as a recorded motion says, in real time: begins "
      "when\n"
      "the node has loaded, and ends with the motion. The clock is ROS's: under /use_sim_time the\n"
      "motion waits for /clock.";
  PlayParams defaults;
  about.params.applyHere(defaults);
  about.says = {
      {instrumentTopic("<instrument>", kMeasuredJoints), "sensor_msgs/JointState",
       "joint positions [m], [rad]; another topic by the scene's joint_topic"},
      {"/tf, /tf_static", "tf2_msgs/TFMessage", "frames of the links, of a scene with input: tf"}};
  return about;
}

PlayParams readPlayParams() {
  PlayParams p;
  ParamFields fields(ros::NodeHandle("~"));
  fields.applyHere(p);
  fields.refuseOthers();
  fields.check();
  return p;
}

void pause(double duration) { std::this_thread::sleep_for(seconds(duration)); }

bool isBag(const std::string& file) {
  constexpr char kEnding[] = ".bag";
  const std::size_t size = sizeof(kEnding) - 1;
  return file.size() > size && file.compare(file.size() - size, size, kEnding) == 0;
}

std::string motionFile(const PlayParams& p, const std::string& scene_file) {
  if (!p.trajectory.empty()) return p.trajectory;
  std::string shipped = start::shippedTrajectory(scene_file);
  if (!shipped.empty()) return shipped;
  throw InputError("parameters of " + ros::NodeHandle("~").getNamespace(), "trajectory", "",
                   "must be given: " + scene_file + " is no scene that comes with one");
}

/// The clock that the motion is played on: the steady one, or that of /use_sim_time.
class Clock {
 public:
  void begin(double rate) {
    steady_ = Steady::now();
    played_ = {ros::Time::now(), rate};
  }
  const PlayedTime& played() const { return played_; }
  /// How far the motion should be [s].
  double now() const {
    const double passed = ros::Time::isSimTime() ? (ros::Time::now() - played_.begin).toSec()
                                                 : inSeconds(Steady::now() - steady_);
    return played_.rate * passed;
  }
  /// Whether it came to `t` [s] of the motion: false if the program ends before.
  bool wait(double t) const {
    while (!Ending::asked()) {
      const double left = (t - now()) / played_.rate;
      if (left <= 0.0) return true;
      pause(std::min(left, ros::Time::isSimTime() ? 1e-3 : kLook));
    }
    return false;
  }

 private:
  Steady::time_point steady_;
  PlayedTime played_;
};

/// Until the scene is loaded: the node has its services then.
void waitForNode(const std::string& node) {
  const std::string service = node + "/" + kResetService;
  Throttle said(10.0);
  said.due();
  while (!Ending::asked() && !ros::service::exists(service, false)) {
    if (said.due()) ROS_INFO("waiting for %s", service.c_str());
    pause(kLook);
  }
}

void waitForListeners(const InputPublishers& publishers) {
  for (double t = 0.0; t < kToConnect && !publishers.unheard().empty(); t += kLook) {
    if (Ending::asked()) return;
    pause(kLook);
  }
  const std::vector<std::string> unheard = publishers.unheard();
  if (!unheard.empty()) ROS_WARN("nobody listens to %s", joinNames(unheard).c_str());
  pause(kBefore);
}

void resetOrgans(const std::string& node) {
  std_srvs::Trigger reset;
  if (!ros::service::call(node + "/" + kResetService, reset) || !reset.response.success) {
    throw std::runtime_error(node + " does not reset its scene");
  }
}

void play(Motion* motion, double rate) {
  Clock clock;
  clock.begin(rate);
  motion->rewind();
  while (const std::optional<double> due = motion->next()) {
    if (!clock.wait(*due)) return;
    motion->send(clock.now(), clock.played());
  }
}

int run(bool) {
  const PlayParams params = readPlayParams();
  const std::string node = nodeName(params.of);
  const std::string file = motionFile(params, nodeSceneFile(params.of));
  const scene::Scene scene = readNodeScene(params.of);
  InputPublishers publishers(ros::NodeHandle(), scene);
  std::unique_ptr<Motion> motion;
  if (isBag(file)) {
    motion = std::make_unique<BagMotion>(file, scene, &publishers);
  } else {
    motion = std::make_unique<TrajectoryMotion>(file, scene, params.rate / params.publish_rate,
                                                &publishers);
  }
  waitForNode(node);
  waitForListeners(publishers);
  while (!ros::Time::isValid() && !Ending::asked()) pause(kLook);  // no /clock yet
  ROS_INFO("playing %s", file.c_str());
  play(motion.get(), params.rate);
  while (params.loop && !Ending::asked()) {
    resetOrgans(node);
    play(motion.get(), params.rate);
  }
  if (!Ending::asked()) pause(kAfter);
  return 0;
}

}  // namespace
}  // namespace palpate::node

int main(int argc, char** argv) {
  using namespace palpate::node;
  return runProgram(argc, argv, "palpate_play", about(), run);
}
