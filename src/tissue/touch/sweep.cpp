// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep.h"

#include <algorithm>

#include "palpate/contact/signed_distance.h"

namespace palpate::tissue {

bool sweepReaches(const ToolBody& body, const Vec3& low, const Vec3& high, double margin) {
  const double reach = contact::boundingRadius(*body.geometry) + margin;
  const Vec3 begin = body.X_WG_begin.translation(), end = body.X_WG_end.translation();
  return (begin.cwiseMin(end).array() - reach <= high.array()).all() &&
         (begin.cwiseMax(end).array() + reach >= low.array()).all();
}

double nextSweepStage(const std::vector<ToolBody>& bodies, const std::vector<double>& allowed,
                      double s) {
  double part = 1.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const instrument::Geometry& geometry = *bodies[b].geometry;
    const double way = contact::sweepLength(geometry, bodies[b].X_WG_begin, bodies[b].X_WG_end);
    if (part * way > allowed[b]) part = allowed[b] / way;
  }
  const double next = s + std::max(part, 1.0 / kMaxSweepStages);
  return next > 1.0 - 1e-9 ? 1.0 : next;
}

}  // namespace palpate::tissue
