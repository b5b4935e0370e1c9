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

double nextSweepStage(const std::vector<ToolBody>& bodies, const std::vector<double>& depths,
                      double s) {
  double part = 1.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const instrument::Geometry& geometry = *bodies[b].geometry;
    const double way = contact::sweepLength(geometry, bodies[b].X_WG_begin, bodies[b].X_WG_end);
    const double allowed = 0.5 * (1.0 - depths[b]) * contact::inscribedRadius(geometry);
    if (part * way > allowed) part = allowed / way;
  }
  const double next = s + std::max(part, 1.0 / kMaxSweepStages);
  return next > 1.0 - 1e-9 ? 1.0 : next;
}

}  // namespace palpate::tissue
