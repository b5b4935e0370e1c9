// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/time.h>

#include <memory>
#include <string>
#include <vector>

#include "palpate/sim/simulator.h"
#include "ros/program/throttle.h"

namespace palpate::node {

/// What is wrong with an input that simulation refuses, see sim::inReach().
inline constexpr char kOutOfReach[] = "puts a link more than 1 km away from the origin of world";

/// Where one instrument is, as last heard.
struct InputSample {
  bool valid = false;  ///< False: nothing heard since the start or forget().
  ros::Time stamp;     ///< Of the message or the transforms.
  Steady::time_point received;
  sim::LinkPoses poses;  ///< X_WL of all links; links that nothing needs may be identity.
};

/// How one instrument's motion comes in. The simulation thread calls everything here.
class Input {
 public:
  virtual ~Input() = default;

  /// Takes the newest input, if there is one newer than in the last call: then true.
  virtual bool poll(InputSample* sample) = 0;

  /// Time went back: what was heard before counts no more.
  virtual void forget() = 0;

  /// Where it listens, for messages: "topic /probe/measured_js", "tf frames world -> tip".
  virtual std::string source() const = 0;

  /// What was wrong with the last input or why there is none; "" if all is well.
  virtual std::string problem() const = 0;

  /// Who else publishes it, and names for both; "" if nobody does.
  virtual std::string conflict() const { return ""; }
};

/// One an instrument.
using Inputs = std::vector<std::unique_ptr<Input>>;

}  // namespace palpate::node
