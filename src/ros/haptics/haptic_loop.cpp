// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptic_loop.h"

#include <algorithm>

#include "palpate/haptics/body_wrench.h"
#include "palpate/scene/hand_settings.h"
#include "ros/guard/crash.h"
#include "ros/guard/ending.h"
#include "ros/messages/conversions.h"
#include "ros/messages/stamps.h"
#include "ros/messages/topics.h"
#include "ros/program/realtime.h"

namespace palpate::node {

namespace {

constexpr int kZeros = 20;           // sent at the end
constexpr double kUntilHeard = 0.5;  // [s] a program that ends at once lets who listens connect
constexpr double kUntilSent = 0.05;  // [s] for the last message

}  // namespace

HapticLoop::HapticLoop(ros::NodeHandle handle, const scene::Scene& scene, Channels* channels)
    : channels_(*channels),
      period_(seconds(1.0 / scene.rates.haptic)),
      silence_(seconds(std::max(scene.rates.stale_after, 5.0 / scene.rates.simulation))) {
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    delay_ = std::max(delay_, instrument.device.delay);
    const auto advertise = [&](const char* topic) {
      return handle.advertise<geometry_msgs::WrenchStamped>(instrumentTopic(instrument.name, topic),
                                                            1);
    };
    hands_.push_back(
        {haptics::ForceRenderer(scene::filterSettings(scene, instrument), scene.haptics,
                                instrument.device, 1.0 / scene.rates.haptic),
         haptics::WrenchRate(scene::filterSettings(scene, instrument)), advertise(kSpatialWrench),
         advertise(kBodyWrench),
         handle.advertise<palpate::ContactModel>(instrumentTopic(instrument.name, kContactModel),
                                                 1),
         instrument.tf_prefix + instrument.control_frame});
  }
}

HapticLoop::~HapticLoop() { finish(); }

void HapticLoop::start() {
  thread_ = std::thread([this] { Ending::guard("force", [this] { loop(); }); });
}

void HapticLoop::finish() {
  finishing_ = true;
  if (!thread_.joinable()) return;
  thread_.join();
  // Here too where the thread failed.
  for (int k = 0; k < kZeros; ++k) {
    for (std::size_t i = 0; i < hands_.size(); ++i) {
      send(&hands_[i], Wrench(), Wrench(), channels_.haptic[i].read(), channels_.hands[i].read());
    }
    std::this_thread::sleep_for(period_);
  }
  std::this_thread::sleep_for(seconds(kUntilSent));
}

bool HapticLoop::atRest() const {
  const auto none = [](const Wrench& wrench) {
    return wrench.force == Vec3::Zero() && wrench.torque == Vec3::Zero();
  };
  return std::all_of(hands_.begin(), hands_.end(), [&](const Hand& hand) {
    return none(hand.force.output()) && none(hand.in_body.output());
  });
}

void HapticLoop::loop() {
  Crash::isFatalHere();
  statistics_.realtime = becomeRealtime();
  const Steady::time_point begin = Steady::now();
  Steady::time_point last = begin, next = begin + period_;
  while (!(finishing_ && atRest() && last - begin > seconds(kUntilHeard))) {
    std::this_thread::sleep_until(next);
    const Steady::time_point now = Steady::now();
    for (std::size_t i = 0; i < hands_.size(); ++i) update(i, now, inSeconds(now - last));
    periods_.add(inSeconds(now - last));
    last = now;
    double taken_back = 0.0, tissue = 0.0, rendered = 0.0;
    for (const Hand& hand : hands_) {
      tissue = std::max(tissue, hand.tissue);
      rendered = std::max(rendered, hand.rendered);
      statistics_.energy_out =
          std::max(statistics_.energy_out.load(), hand.force.passivity().largestOut());
      taken_back += hand.force.passivity().dissipated();
    }
    statistics_.taken_back = taken_back;
    statistics_.tissue = tissue;
    statistics_.rendered = rendered;
    channels_.haptics_seconds = inSeconds(Steady::now() - now);
    ++statistics_.cycles;
    next += period_;
    if (next + period_ < now) {
      ++statistics_.late;
      next = now;
    }
  }
}

void HapticLoop::update(std::size_t i, Steady::time_point now, double dt) {
  const bool solved = channels_.haptic[i].hasNew();
  const HapticTarget& target = channels_.haptic[i].read();
  Hand& hand = hands_[i];
  if (solved && target.render.live && hand.model.getNumSubscribers() > 0) {
    hand.model.publish(toMsg(target.render.contact.model, target.stamp));
  }
  haptics::RenderTarget render = target.render;
  render.live &= !finishing_ && now - target.made < silence_;
  const bool heard = channels_.hands[i].hasNew();
  const HandPose& pose = channels_.hands[i].read();
  if (heard && !ros::Time::isSimTime()) {
    latencies_.add(secondsBetween(pose.stamp, ros::Time::now()));
  }
  const Wrench& spatial =
      pose.valid ? hand.force.update(render, pose.p_WC, dt) : hand.force.fade(dt);
  hand.tissue = render.live ? render.contact.tissue_stiffness : 0.0;
  hand.rendered = render.live ? render.contact.stiffness : 0.0;
  const Wrench& body = hand.in_body.follow(haptics::bodyWrench(spatial, pose.R_WC), dt);
  send(&hand, spatial, body, target, pose);
  const double force = spatial.force.norm();
  if (force > statistics_.peak_force) statistics_.peak_force = force;
}

// The stamp is that of the pose for which it is.
void HapticLoop::send(Hand* hand, const Wrench& spatial, const Wrench& body,
                      const HapticTarget& target, const HandPose& pose) {
  const ros::Time stamp = target.valid && pose.valid ? pose.stamp : ros::Time::now();
  if (hand->spatial.getNumSubscribers() > 0) {
    hand->spatial.publish(toMsg(spatial, stamp, kWorldFrame));
  }
  if (hand->body.getNumSubscribers() > 0) {
    hand->body.publish(toMsg(body, stamp, hand->body_frame));
  }
}

}  // namespace palpate::node
