// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::tissue {

/// Switches of work that is skipped where a scene does not need it. False: the work is done, to
/// measure its cost and check equal results. tissue/skips.h documents each.
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
