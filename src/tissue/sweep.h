// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Whether the body, anywhere on its way, may come within `margin` [m] of the box low .. high.
/// Never a false no.
bool sweepReaches(const ToolBody& body, const Vec3& low, const Vec3& high, double margin);

/// Into how many parts to cut a cycle so that no body moves by more than half its inscribed radius
/// in one: the tissue in front of it then always sees the side that it came from. At most
/// kMaxSweepStages; a tool that leaps farther was not moved by a hand.
int sweepStages(const std::vector<ToolBody>& bodies);

constexpr int kMaxSweepStages = 64;

}  // namespace palpate::tissue
