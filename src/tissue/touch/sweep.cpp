// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep.h"

#include <algorithm>

#include "palpate/contact/signed_distance.h"

namespace palpate::tissue {

bool sweepReaches(const contact::Obstacle& obstacle, const Vec3& low, const Vec3& high,
                  double margin) {
  const double reach = contact::boundingRadius(*obstacle.geometry) + margin;
  const Vec3 begin = obstacle.X_WG_begin.translation(), end = obstacle.X_WG_end.translation();
  return (begin.cwiseMin(end).array() - reach <= high.array()).all() &&
         (begin.cwiseMax(end).array() + reach >= low.array()).all();
}

double nextSweepStage(const std::vector<contact::Obstacle>& obstacles,
                      const std::vector<double>& allowed, double s) {
  double part = 1.0;
  for (std::size_t b = 0; b < obstacles.size(); ++b) {
    const contact::Obstacle& obstacle = obstacles[b];
    const double way =
        contact::sweepLength(*obstacle.geometry, obstacle.X_WG_begin, obstacle.X_WG_end);
    if (part * way > allowed[b]) part = allowed[b] / way;
  }
  const double next = s + std::max(part, 1.0 / kMaxSweepStages);
  return next > 1.0 - 1e-9 ? 1.0 : next;
}

}  // namespace palpate::tissue
