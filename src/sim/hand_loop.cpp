// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/hand_loop.h"

#include <algorithm>
#include <cmath>

namespace palpate::sim {
namespace {

constexpr double kRounding = 1e-9;  // of times [s]

}  // namespace

HandLoop::HandLoop(Simulator* simulator, int instrument, const LinkPoses& start,
                   const HandLoopSettings& settings)
    : simulator_(*simulator),
      instrument_(instrument),
      start_(start),
      settings_(settings),
      link_(static_cast<std::size_t>(simulator->controlLink(instrument))),
      hand_(settings.hand, Vec3::Zero()),
      tool_(settings.coupling, settings.told, settings.tick),
      force_(settings.filter, settings.passivity, settings.told, settings.tick),
      poses_(static_cast<std::size_t>(simulator->numInstruments())),
      every_(std::max(1L, std::lround(1.0 / (settings.device_rate * settings.tick)))) {}

// The newest value that has arrived, or the one before.
Vec3 HandLoop::newest(std::deque<Sent>* sent, double until, const Vec3& before) {
  Vec3 value = before;
  while (!sent->empty() && sent->front().time <= until + kRounding) {
    value = sent->front().value;
    sent->pop_front();
  }
  return value;
}

// The tool goes where the device was last heard to be. What comes out is known when it is done.
void HandLoop::beginCycle() {
  LinkPoses& links = poses_[static_cast<std::size_t>(instrument_)];
  links = start_;
  const Vec3 p_start = start_[link_].translation();
  const Vec3 p_target = tool_.target(p_start + heard_);
  for (Pose& X : links) X.pretranslate(p_target - p_start);
  const StepResult& result = simulator_.step(poses_, settings_.cycle);
  const InstrumentResult& tool = result.instruments[static_cast<std::size_t>(instrument_)];
  solved_ = tool.live
                ? tool_.observe(p_target, tool.X_WC.translation(), tool.solved, settings_.cycle)
            : tool.there ? tool_.fade()
            : tool.there ? tool_.fade()
                         : tool_.lose();
  if (!settings_.ahead) solved_.contact.lead = 0.0;
  if (settings_.local_model) return;
  // The wrench alone, and nothing that follows from its stiffness.
  solved_.contact.model.stiffness_W.setZero();
}

const HandTick& HandLoop::tick(const HandIntent& intent) {
  const double t = settings_.tick * static_cast<double>(ticks_);
  const bool device_ticks = ticks_++ % every_ == 0;
  if (device_ticks) positions_.push_back({t + settings_.delay_in, hand_.measured()});
  heard_ = newest(&positions_, t, heard_);

  if (under_way_ && t >= ready_ - kRounding) {
    target_ = solved_;
    under_way_ = false;
  }
  if (!under_way_ && t >= next_cycle_ - kRounding) {
    beginCycle();
    under_way_ = true;
    ready_ = t + settings_.solve;
    next_cycle_ += settings_.cycle;
  }

  const Wrench& wrench =
      force_.update(target_, start_[link_].translation() + heard_, settings_.tick);
  forces_.push_back({t + settings_.delay_out, wrench.force});
  if (device_ticks) rendered_ = newest(&forces_, t, rendered_);

  if (settings_.prescribed) {
    hand_.setState(intent.position + settings_.tick * intent.velocity, intent.velocity);
  } else {
    hand_.tick(intent.position, intent.velocity, rendered_, intent.push, settings_.tick);
  }
  done_ = {t + settings_.tick,
           hand_.position(),
           intent.position,
           rendered_,
           target_.contact.model.wrench.force,
           target_.contact.tissue_stiffness,
           target_.contact.stiffness};
  return done_;
}

}  // namespace palpate::sim
