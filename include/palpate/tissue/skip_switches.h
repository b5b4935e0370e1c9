// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::tissue {

/// Work that is left out where a scene does not need it. False: it is done all the same, to see
/// that the answer stays and what it costs. What each means and counts stands in tissue/skips.h.
struct SkipSwitches {
  bool sleeping = true;
  bool islands = true;
  bool far_tools = true;
  bool apart_organs = true;
  bool distant_samples = true;
  bool inactive_samples = true;
  bool viscous_terms = true;
  bool unchanged_stiffness = true;
};

}  // namespace palpate::tissue
