// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "palpate/sim/hand_tools.h"
#include "palpate/sim/simulator.h"

namespace palpate::sim {

/// Interpretation of recorded inputs.
enum class Cycles {
  kByTime,  ///< Time since the last input, in equal steps of at most `solver.step`.
  kLive     ///< One cycle of `solver.step` per input, as in the live node, with HandTools.
};

/// Steps a simulator to the times of recorded inputs, one call per input; poses are interpolated
/// over the steps of an input.
class Lockstep {
 public:
  /// kLive is bitwise equal to the live node for tools driven by hands: scene::driveByHands().
  explicit Lockstep(Simulator* simulator, Cycles cycles = Cycles::kByTime);

  /// Steps to the input `poses` at time `t` [s]. The first input, and one before the last or more
  /// than 1e5 steps later, which resets the simulator, sets the tools and makes one step of
  /// `solver.step`. An equal time makes no step. Report and penetrations merge all steps by
  /// reportFigures(); wrenches and contacts are those of the last.
  const StepResult& advance(double t, const std::vector<LinkPoses>& poses);

  /// Continues from a restored simulator, whose last input was `poses` at time `t` [s].
  void resume(double t, const std::vector<LinkPoses>& poses);

  const StepResult& result() const { return result_; }
  /// Number of steps of the last advance(), or 0.
  int parts() const { return parts_; }

 private:
  void liveCycle(const std::vector<LinkPoses>& poses);
  void stepBetween(const std::vector<LinkPoses>& from, const std::vector<LinkPoses>& to,
                   double duration);

  Simulator* simulator_;
  std::optional<HandTools> tools_;  // of live cycles
  bool started_ = false;
  double time_ = 0.0;
  int parts_ = 0;
  std::vector<LinkPoses> poses_;
  StepResult result_;
};

}  // namespace palpate::sim
