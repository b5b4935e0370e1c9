// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/haptics/tool_renderer.h"
#include "palpate/sim/simulator.h"

namespace palpate::sim {

/// Virtual couplings between hands and tools of a simulator: where tissue is too stiff for a
/// device, its tool is less deep than the hand. Reads no clock.
class HandTools {
 public:
  explicit HandTools(const Simulator& simulator);

  /// Target poses of the tools for the hands' poses; empty poses stay empty.
  void target(std::vector<LinkPoses>* poses);

  /// Takes the result of instrument `i` in a step of `dt` [s] to `target`; `held`: its hand is
  /// present.
  const haptics::RenderTarget& observe(std::size_t i, bool held, const LinkPoses& target,
                                       const InstrumentResult& tool, double dt);

  /// Clears the couplings: the simulator was reset.
  void lose();

 private:
  std::vector<haptics::ToolRenderer> tools_;  // one per instrument
  std::vector<std::size_t> links_;            // links of the control frames
};

}  // namespace palpate::sim
