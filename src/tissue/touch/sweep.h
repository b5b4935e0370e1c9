// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/obstacle.h"

namespace palpate::tissue {

/// Whether the obstacle, anywhere on its way, may come within `margin` [m] of the box low .. high.
/// Never a false no.
bool sweepReaches(const contact::Obstacle& obstacle, const Vec3& low, const Vec3& high,
                  double margin);

/// How far along the rest of the sweep, from `s` in [0, 1), the obstacles may go before the tissue
/// is solved again, so that the tissue in front always sees the side that it came from. `allowed`:
/// how far each of them may move [m]. At least 1 / kMaxSweepStages: a tool that leaps farther was
/// not moved by a hand.
double nextSweepStage(const std::vector<contact::Obstacle>& obstacles,
                      const std::vector<double>& allowed, double s);

constexpr int kMaxSweepStages = 64;

}  // namespace palpate::tissue
