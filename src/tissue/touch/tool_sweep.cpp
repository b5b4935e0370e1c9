// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_sweep.h"

#include <algorithm>
#include <limits>

#include "palpate/contact/signed_distance.h"
#include "sweep.h"

namespace palpate::tissue {

int ToolSweep::begin(const std::vector<ToolBody>& bodies, const Points& x, double way) {
  // The tissue may move on as fast as it does, and farther where it is pushed: candidatesHold()
  // notices when it went beyond.
  margin_ = 0.02 * size_ + 2.0 * way;
  const Vec3 low = x.rowwise().minCoeff(), high = x.rowwise().maxCoeff();
  near_.clear();
  for (const ToolBody& body : bodies) {
    if (!skip_far_ || sweepReaches(body, low, high, margin_)) near_.push_back(body);
  }
  return static_cast<int>(bodies.size() - near_.size());
}

void ToolSweep::search(const Points& x) {
  reach_.clear();
  for (const ToolBody& body : near_) {
    reach_.push_back(margin_ +
                     contact::sweepLength(*body.geometry, body.X_WG_begin, body.X_WG_end));
  }
  contact_.findCandidates(x, reach_);
  searched_at_ = x;
}

void ToolSweep::place(double s) {
  placed_.clear();
  for (const ToolBody& body : near_) {
    placed_.push_back(
        {body.geometry, contact::interpolate(body.X_WG_begin, body.X_WG_end, s), body.instrument});
  }
  contact_.setBodies(placed_);
}

double ToolSweep::next(const Points& x, double s, double end) {
  if (!contact_.hasCandidates()) return end;
  contact_.allowedMotions(x, &allowed_);
  return std::min(end, nextSweepStage(near_, allowed_, s));
}

double ToolSweep::leap(double size) const {
  double longest = 0.0;
  for (const ToolBody& body : near_) {
    const double way = contact::sweepLength(*body.geometry, body.X_WG_begin, body.X_WG_end);
    longest = std::max(longest, way / std::min(size, contact::inscribedRadius(*body.geometry)));
  }
  return longest;
}

double ToolSweep::thinnest() const {
  double least = std::numeric_limits<double>::infinity();
  for (const ToolBody& body : near_) {
    least = std::min(least, contact::inscribedRadius(*body.geometry));
  }
  return least;
}

}  // namespace palpate::tissue
