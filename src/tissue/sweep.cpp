// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep.h"

#include <algorithm>
#include <cmath>

#include "palpate/contact/signed_distance.h"

namespace palpate::tissue {

bool sweepReaches(const ToolBody& body, const Vec3& low, const Vec3& high, double margin) {
  const double reach = contact::boundingRadius(*body.geometry) + margin;
  const Vec3 begin = body.X_WG_begin.translation(), end = body.X_WG_end.translation();
  return (begin.cwiseMin(end).array() - reach <= high.array()).all() &&
         (begin.cwiseMax(end).array() + reach >= low.array()).all();
}

int sweepStages(const std::vector<ToolBody>& bodies) {
  double stages = 1.0;
  for (const ToolBody& body : bodies) {
    const double way = contact::sweepLength(*body.geometry, body.X_WG_begin, body.X_WG_end);
    stages = std::max(stages, std::ceil(way / (0.5 * contact::inscribedRadius(*body.geometry))));
  }
  return static_cast<int>(std::min(stages, double{kMaxSweepStages}));
}

}  // namespace palpate::tissue
