// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_device: a simulated haptic device and the hand that holds it, in real time. It publishes
// joint positions as a master arm does, and feels the wrench that comes back, held as drivers hold
// it. The hand goes down, stays, trembles, and comes up. Its parameters: --help.
#include <geometry_msgs/WrenchStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "palpate/haptics/simulated_hand.h"
#include "ros/guard/ending.h"
#include "ros/messages/conversions.h"
#include "ros/program/param_fields.h"
#include "ros/program/program.h"
#include "ros/program/realtime.h"
#include "ros/program/throttle.h"

namespace palpate::node {
namespace {

constexpr double kTick = 1.0e-3;     // [s]
constexpr double kTremorRate = 4.0;  // [Hz]
constexpr double kBefore = 0.5;      // [s] at the start, so that the node has heard of it

struct DeviceParams {
  std::string joints = "/probe/measured_js", wrench = "/probe/spatial/measured_cf";
  std::string after = "/palpate/reset";
  std::vector<std::string> names = {"x", "y", "z", "roll", "pitch", "yaw"};
  std::vector<double> start = std::vector<double>(6, 0.0);
  double way = 0.02, speed = 0.03, hold = 3.0, tremor = 0.0;
  haptics::HandSettings hand;
};

void describe(keys::FieldVisitor& v, DeviceParams& p) {
  const keys::Range positive = keys::Range::above(0.0), not_negative = keys::Range::closed(0.0);
  v.text({"joints", "", "Topic of the joint positions."}, p.joints);
  v.text({"wrench", "", "Topic of the wrench."}, p.wrench);
  v.text({"after", "", "Service that is there when the scene is loaded; empty: begins at once."},
         p.after);
  v.number({"way", "m", "How far down the hand means to go."}, p.way, not_negative);
  v.number({"speed", "m/s", "On the way."}, p.speed, positive);
  v.number({"hold", "s", "How long the hand stays there."}, p.hold, not_negative);
  v.number({"tremor", "m", "How far the hand then trembles, at 4 Hz and as long."}, p.tremor,
           not_negative);
  v.number({"mass", "kg", "Of device and hand."}, p.hand.mass, positive);
  v.number({"damping", "N s/m", "Of the device."}, p.hand.device_damping, not_negative);
  v.number({"grip_stiffness", "N/m", "Of the grip."}, p.hand.grip_stiffness, not_negative);
  v.number({"grip_damping", "N s/m", "Of the grip."}, p.hand.grip_damping, not_negative);
  v.number({"resolution", "m", "Of the encoders."}, p.hand.resolution, not_negative);
}

template <class Fields>
void visit(Fields& fields, DeviceParams& p) {
  fields.applyHere(p);
  fields.texts({"names", "", "Joints; the first three move along world's x, y, z."}, p.names);
  fields.numbers({"start", "m, rad", "Positions of the joints at the start."}, p.start);
  fields.rule(p.start.size() == p.names.size() && p.names.size() >= 3, "start",
              "must have one for each of ~names, three at least");
}

DeviceParams readDeviceParams(const ros::NodeHandle& handle) {
  DeviceParams p;
  ParamFields fields(handle);
  visit(fields, p);
  fields.refuseOthers();
  fields.check();
  return p;
}

About about() {
  About about;
  about.program = "palpate_device";
  about.what =
      "A simulated haptic device and the hand that holds it, in real time. It publishes joint\n"
      "positions as a master arm does, and feels the wrench that comes back. The hand goes down,\n"
      "stays, trembles, and comes up; then the program ends.";
  DeviceParams defaults;
  visit(about.params, defaults);
  about.hears = {
      {"~wrench", "geometry_msgs/WrenchStamped", "in world axes, held as drivers hold it"}};
  about.says = {{"~joints", "sensor_msgs/JointState", "joint positions, 1 kHz"}};
  return about;
}

/// Where the hand means to be at a time, and how fast it goes there, along z.
struct Intent {
  double z, v;
};
Intent intentAt(const DeviceParams& p, double t) {
  const double down = p.way / p.speed;
  if (t < 0.0) return {0.0, 0.0};
  if (t < down) return {-p.speed * t, -p.speed};
  if (t < down + p.hold) return {-p.way, 0.0};
  if (t < down + 2.0 * p.hold) {
    const double omega = 2.0 * M_PI * kTremorRate, s = omega * (t - down - p.hold);
    return {-p.way + p.tremor * std::sin(s), p.tremor * omega * std::cos(s)};
  }
  const double up = t - down - 2.0 * p.hold;
  return up < down ? Intent{-p.way + p.speed * up, p.speed} : Intent{0.0, 0.0};
}

class Device {
 public:
  Device(ros::NodeHandle handle, const DeviceParams& params)
      : params_(params),
        hand_(params.hand, Vec3::Zero()),
        joints_(handle.advertise<sensor_msgs::JointState>(params.joints, 1)),
        wrench_(handle.subscribe(params.wrench, 1, &Device::feel, this,
                                 ros::TransportHints().tcpNoDelay())) {
    message_.name = params.names;
    message_.position = params.start;
  }

  /// The organs may not be there yet.
  void wait() const {
    while (!params_.after.empty() && !Ending::asked() &&
           !ros::service::exists(params_.after, false)) {
      std::this_thread::sleep_for(seconds(0.05));
    }
  }

  void run() {
    const double end = 2.0 * params_.way / params_.speed + 2.0 * params_.hold + 0.5;
    Steady::time_point next = Steady::now();
    for (double t = -kBefore; t < end && !Ending::asked(); t += kTick) {
      ros::getGlobalCallbackQueue()->callAvailable();
      const Intent meant = intentAt(params_, t);
      hand_.tick(Vec3(0.0, 0.0, meant.z), Vec3(0.0, 0.0, meant.v), force_, Vec3::Zero(), kTick);
      const Vec3 p = hand_.measured();
      for (int k = 0; k < 3; ++k) message_.position[k] = params_.start[k] + p[k];
      message_.header.stamp = ros::Time::now();
      joints_.publish(message_);
      next += seconds(kTick);
      std::this_thread::sleep_until(next);
    }
  }

 private:
  void feel(const geometry_msgs::WrenchStamped& message) {
    const Wrench wrench = fromMsg(message.wrench);
    if (wrench.allFinite()) force_ = wrench.force;
  }

  DeviceParams params_;
  haptics::SimulatedHand hand_;
  Vec3 force_ = Vec3::Zero();
  sensor_msgs::JointState message_;
  ros::Publisher joints_;
  ros::Subscriber wrench_;
};

}  // namespace
}  // namespace palpate::node

int main(int argc, char** argv) {
  using namespace palpate::node;
  return runProgram(argc, argv, "palpate_device", about(), [](bool) {
    Device device(ros::NodeHandle(), readDeviceParams(ros::NodeHandle("~")));
    becomeRealtime();
    device.wait();
    device.run();
    return 0;
  });
}
