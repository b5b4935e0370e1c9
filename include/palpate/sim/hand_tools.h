// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/haptics/tool_renderer.h"
#include "palpate/sim/simulator.h"

namespace palpate::sim {

/// What stands between the hands and the tools of a simulator whose forces are felt: where tissue
/// is too stiff for a hand's device, its tool goes less deep than the hand. No clock.
class HandTools {
 public:
  explicit HandTools(const Simulator& simulator);

  /// From where the hands hold their tools to where the tools are to go. A tool that is not there,
  /// without poses, stays so.
  void target(std::vector<LinkPoses>* poses);

  /// What instrument `i` felt in a step of `dt` [s] to `target`, for its hand; `held`: the hand is
  /// there still.
  const haptics::RenderTarget& observe(std::size_t i, bool held, const LinkPoses& target,
                                       const InstrumentResult& tool, double dt);

  /// Nobody holds one: the simulator was reset.
  void lose();

 private:
  std::vector<haptics::ToolRenderer> tools_;  // one an instrument
  std::vector<std::size_t> links_;            // with the control frames
};

}  // namespace palpate::sim
