// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/obstacle.h"

namespace palpate::tissue {

/// Whether the obstacle may come nearer than `margin` [m] to the box [low, high] on its path.
/// Conservative: may be true without a collision, is never false with one.
bool sweepReaches(const contact::Obstacle& obstacle, const Vec3& low, const Vec3& high,
                  double margin);

/// End of the next stage, as a fraction of the tool path after `s` in [0, 1): no obstacle moves
/// farther than `allowed` [m], so that tissue stays on its side. Stages have at least
/// 1 / kMaxSweepStages of the path, since no hand moves faster.
double nextSweepStage(const std::vector<contact::Obstacle>& obstacles,
                      const std::vector<double>& allowed, double s);

constexpr int kMaxSweepStages = 64;

}  // namespace palpate::tissue
