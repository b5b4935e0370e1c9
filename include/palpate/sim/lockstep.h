// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/sim/simulator.h"

namespace palpate::sim {

/// Steps a simulator to the times of recorded inputs, the same way wherever they come from. One
/// call an input: the simulated step is the time since the last one, cut into equal parts of at
/// most the scene's `solver.step` with the poses interpolated between.
class Lockstep {
 public:
  explicit Lockstep(Simulator* simulator) : simulator_(simulator) {}

  /// The input `poses` of time `t` [s]. The first one, and one that is earlier than the last or
  /// more than 1e5 steps later (which resets the simulator), places the tools and makes one step of
  /// `solver.step`. The same time again makes no step. The report and the
  /// penetrations are of all parts, see reportFigures(); wrenches and contacts of the last one.
  const StepResult& advance(double t, const std::vector<LinkPoses>& poses);

  /// The simulator was restored to where the input `poses` of time `t` [s] had left it, and goes on
  /// from there.
  void resume(double t, const std::vector<LinkPoses>& poses);

  const StepResult& result() const { return result_; }
  /// Simulated steps that the last advance() was cut into; 0 if it made none.
  int parts() const { return parts_; }

 private:
  void stepBetween(const std::vector<LinkPoses>& from, const std::vector<LinkPoses>& to,
                   double duration);

  Simulator* simulator_;
  bool started_ = false;
  double time_ = 0.0;
  int parts_ = 0;
  std::vector<LinkPoses> poses_;
  StepResult result_;
};

}  // namespace palpate::sim
