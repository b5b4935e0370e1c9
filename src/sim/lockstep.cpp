// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/lockstep.h"

#include <algorithm>
#include <cmath>

#include "palpate/contact/signed_distance.h"

namespace palpate::sim {
namespace {

// A silence of more steps than this is a new recording, not a long pause.
constexpr double kMaxParts = 1e5;

std::vector<LinkPoses> between(const std::vector<LinkPoses>& from, const std::vector<LinkPoses>& to,
                               double s) {
  std::vector<LinkPoses> poses = to;
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (from[i].empty()) continue;  // it was not there
    for (std::size_t l = 0; l < to[i].size(); ++l) {
      poses[i][l] = contact::interpolate(from[i][l], to[i][l], s);
    }
  }
  return poses;
}

// The report of all sub-steps so far; wrenches and contacts stay those of the last one.
void addEarlier(const StepResult& earlier, StepResult* result) {
  addSubSteps(earlier.report, &result->report);
  for (std::size_t i = 0; i < result->instruments.size(); ++i) {
    double& deepest = result->instruments[i].max_penetration;
    deepest = std::max(deepest, earlier.instruments[i].max_penetration);
  }
}

}  // namespace

Lockstep::Lockstep(Simulator* simulator, Cycles cycles) : simulator_(simulator) {
  if (cycles == Cycles::kLive) tools_.emplace(*simulator);
}

void Lockstep::liveCycle(const std::vector<LinkPoses>& poses) {
  const double step = simulator_->scene().solver.step;
  std::vector<LinkPoses> targets = poses;
  tools_->target(&targets);
  result_ = simulator_->step(targets, step);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    tools_->observe(i, true, targets[i], result_.instruments[i], step);
  }
  parts_ = 1;
}

void Lockstep::stepBetween(const std::vector<LinkPoses>& from, const std::vector<LinkPoses>& to,
                           double duration) {
  const double longest = simulator_->scene().solver.step;
  const double parts = std::max(std::ceil(duration / longest - 1e-6), 1.0);
  parts_ = static_cast<int>(parts);
  for (int k = 1; k <= static_cast<int>(parts); ++k) {
    const StepResult earlier = result_;
    result_ = k < parts ? simulator_->step(between(from, to, k / parts), duration / parts)
                        : simulator_->step(to, duration / parts);
    if (k > 1) addEarlier(earlier, &result_);
  }
}

const StepResult& Lockstep::advance(double t, const std::vector<LinkPoses>& poses) {
  parts_ = 0;
  if (started_ && t == time_) return result_;
  const double longest_gap = kMaxParts * simulator_->scene().solver.step;
  const bool anew = started_ && !(t > time_ && t - time_ <= longest_gap);
  if (anew) simulator_->reset();
  if (anew && tools_) tools_->lose();
  const bool restart = !started_ || anew;
  if (tools_) {
    liveCycle(poses);
  } else {
    stepBetween(restart ? poses : poses_, poses,
                restart ? simulator_->scene().solver.step : t - time_);
  }
  started_ = true;
  time_ = t;
  poses_ = poses;
  return result_;
}

void Lockstep::resume(double t, const std::vector<LinkPoses>& poses) {
  started_ = true;
  time_ = t;
  poses_ = poses;
}

}  // namespace palpate::sim
