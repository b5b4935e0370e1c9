// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_wire: how regularly a wrench comes, to one who hears it at real-time priority as a
// device's driver does. Prints the percentiles of the period after a second. Its parameters:
// --help.
#include <geometry_msgs/WrenchStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "palpate/base/percentiles.h"
#include "ros/guard/ending.h"
#include "ros/program/param_fields.h"
#include "ros/program/program.h"
#include "ros/program/realtime.h"
#include "ros/program/throttle.h"

namespace palpate::node {
namespace {

constexpr double kSettlingTime = 1.0;  // [s] left out at the start

struct WireParams {
  std::string wrench = "/probe/spatial/measured_cf";
  double seconds = 20.0;
};

void describe(keys::FieldVisitor& v, WireParams& p) {
  v.text({"wrench", "",
          "Topic of the wrench; empty: ticks of 1 ms in its place, the best of the machine."},
         p.wrench);
  v.number({"seconds", "s", "For how long."}, p.seconds, keys::Range::open(0.0, 1.0e5));
}

WireParams readWireParams(const ros::NodeHandle& handle) {
  WireParams p;
  ParamFields fields(handle);
  fields.applyHere(p);
  fields.refuseOthers();
  fields.check();
  return p;
}

About about() {
  About about;
  about.program = "palpate_wire";
  about.what =
      "Measures how regularly a wrench comes, to one who hears it at real-time priority as a\n"
      "device's driver does. Prints the percentiles of the period after a second.";
  WireParams defaults;
  about.params.applyHere(defaults);
  about.hears = {{"~wrench", "geometry_msgs/WrenchStamped", "what is measured"}};
  return about;
}

class Wire {
 public:
  explicit Wire(const WireParams& params) : topic_(params.wrench), seconds_(params.seconds) {
    came_.reserve(static_cast<std::size_t>(2000.0 * (seconds_ + kSettlingTime)));
  }

  int run(bool realtime) {
    ros::NodeHandle handle;
    ros::Subscriber subscriber;
    if (!topic_.empty()) {
      subscriber =
          handle.subscribe(topic_, 1000, &Wire::hear, this, ros::TransportHints().tcpNoDelay());
    }
    const Steady::time_point end = Steady::now() + seconds(kSettlingTime + seconds_);
    Steady::time_point tick = Steady::now();
    while (Steady::now() < end && !Ending::asked()) {
      if (topic_.empty()) {
        tick += seconds(1.0e-3);
        std::this_thread::sleep_until(tick);
        came_.push_back(Steady::now());
      } else {
        ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
      }
    }
    std::vector<double> periods;  // [ms]
    for (std::size_t k = 1; k < came_.size(); ++k) {
      if (came_[k] - came_.front() < seconds(kSettlingTime)) continue;
      periods.push_back(1e3 * inSeconds(came_[k] - came_[k - 1]));
    }
    if (periods.empty()) {
      std::fprintf(stderr, "palpate_wire: nothing came on %s\n", topic_.c_str());
      return 1;
    }
    const Percentiles p = percentiles(periods);
    std::printf("%zu %s%s: period p50 %.3f p99 %.3f p99.9 %.3f max %.3f ms\n", periods.size(),
                topic_.empty() ? "ticks" : "wrenches",
                realtime ? "" : ", heard at ordinary priority", p.p50, p.p99,
                quantile(periods, 0.999), p.max);
    return 0;
  }

 private:
  void hear(const geometry_msgs::WrenchStamped&) { came_.push_back(Steady::now()); }

  std::string topic_;
  double seconds_;
  std::vector<Steady::time_point> came_;
};

}  // namespace
}  // namespace palpate::node

int main(int argc, char** argv) {
  using namespace palpate::node;
  return runProgram(argc, argv, "palpate_wire", about(), [](bool) {
    const bool realtime = becomeRealtime();
    return Wire(readWireParams(ros::NodeHandle("~"))).run(realtime);
  });
}
