// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "palpate/sim/hand_tools.h"
#include "palpate/sim/simulator.h"

namespace palpate::sim {

/// What a recorded input is simulated as.
enum class Cycles {
  kByTime,  ///< The time since the last one, cut into equal parts of at most `solver.step`.
  kLive     ///< A cycle of the live node, `solver.step`; tools are hands', see HandTools.
};

/// Steps a simulator to the times of recorded inputs, the same way wherever they come from. One
/// call an input; between the parts that one is cut into, poses are interpolated.
class Lockstep {
 public:
  /// `kLive` gives the bits of the live node where the scene's tools are driven by hands, see
  /// scene::driveByHands().
  explicit Lockstep(Simulator* simulator, Cycles cycles = Cycles::kByTime);

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
