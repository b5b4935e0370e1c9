// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/hand_loop.h"

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
      hand_(settings.hand, Vec3::Zero()),
      filter_(settings.filter),
      passivity_(settings.passivity),
      poses_(static_cast<std::size_t>(simulator->numInstruments())) {}

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
  for (Pose& X : links) X.pretranslate(heard_);
  const StepResult& result = simulator_.step(poses_, settings_.cycle);
  const InstrumentResult& tool = result.instruments[static_cast<std::size_t>(instrument_)];
  if (tool.there) {
    solved_ = local_.observe(tool.X_WC.translation(), tool.spatial);
  } else {
    local_.forget();
    solved_ = {};
  }
}

const HandTick& HandLoop::tick(const HandIntent& intent) {
  const double t = settings_.tick * static_cast<double>(ticks_++);
  positions_.push_back({t + settings_.delay_in, hand_.measured()});
  heard_ = newest(&positions_, t, heard_);

  if (under_way_ && t >= ready_ - kRounding) {
    model_ = solved_;
    under_way_ = false;
  }
  if (!under_way_ && t >= next_cycle_ - kRounding) {
    beginCycle();
    under_way_ = true;
    ready_ = t + settings_.solve;
    next_cycle_ += settings_.cycle;
  }

  const int link = simulator_.controlLink(instrument_);
  const Vec3 p_W = start_[static_cast<std::size_t>(link)].translation() + heard_;
  Wrench target = settings_.local_model ? model_.at(p_W) : model_.wrench;
  target.force += passivity_.update(heard_, filter_.output().force, target.force, settings_.tick);
  const Wrench& wrench = filter_.update(target, true, settings_.tick);
  forces_.push_back({t + settings_.delay_out, wrench.force});
  rendered_ = newest(&forces_, t, rendered_);

  hand_.tick(intent.position, intent.velocity, rendered_, intent.push, settings_.tick);
  done_ = {t + settings_.tick, hand_.position(), intent.position, rendered_, model_.wrench.force};
  return done_;
}

}  // namespace palpate::sim
