// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/contact/signed_distance.h"

namespace palpate::contact {
namespace {

constexpr int kCandidatesOfPart = 8;  // candidates

}  // namespace

void SampleRuns::build(const std::vector<SurfaceSample>& samples,
                       const std::vector<SampleCandidate>& candidates,
                       const std::vector<PosedObstacle>& posed, double largest_offset) {
  triangles_.clear();
  parts_.clear();
  errors_.clear();
  offset_ = largest_offset;
  for (const PosedObstacle& obstacle : posed) {
    errors_.push_back(distanceError(*obstacle.obstacle().geometry));
  }
  const auto weights = [&](int c) -> const Vec3& {
    return samples[static_cast<std::size_t>(candidates[static_cast<std::size_t>(c)].sample)]
        .weights;
  };
  const int count = static_cast<int>(candidates.size());
  for (int begin = 0, end = 0; begin < count; begin = end) {
    const SampleCandidate& first = candidates[static_cast<std::size_t>(begin)];
    const Eigen::Vector3i nodes = samples[static_cast<std::size_t>(first.sample)].nodes;
    const auto same = [&](const SampleCandidate& c) {
      return c.obstacle == first.obstacle &&
             samples[static_cast<std::size_t>(c.sample)].nodes == nodes;
    };
    for (end = begin + 1; end < count && same(candidates[static_cast<std::size_t>(end)]);) ++end;
    Run run{nodes, first.obstacle, begin, end, static_cast<int>(parts_.size()), 0, {}};
    for (int at = begin; at < end; at += kCandidatesOfPart) {
      Run part = run;
      part.begin = at;
      part.end = std::min(at + kCandidatesOfPart, end);
      part.ball = SampleBall::around(part.begin, part.end, weights);
      parts_.push_back(part);
    }
    run.last_part = static_cast<int>(parts_.size());
    run.ball = SampleBall::around(begin, end, weights);
    triangles_.push_back(run);
  }
  known_.assign(triangles_.size(), {0.0, Mat3::Zero(), -1});
  poses_.clear();
}

void SampleRuns::lookAt(const std::vector<PosedObstacle>& posed) const {
  if (poses_.size() != posed.size()) {
    poses_.clear();
    for (const PosedObstacle& obstacle : posed) poses_.push_back(obstacle.obstacle().X_WG_end);
    places_.assign(posed.size(), places_.empty() ? 0 : places_.front() + 1);
    return;
  }
  for (std::size_t b = 0; b < posed.size(); ++b) {
    const Pose& now = posed[b].obstacle().X_WG_end;
    if (now.matrix() == poses_[b].matrix()) continue;
    poses_[b] = now;
    ++places_[b];
  }
}

// A distance changes by no more than the way; infinitely little is known of another place.
double SampleRuns::knownGap(std::size_t triangle, const Points& x) const {
  const Run& run = triangles_[triangle];
  const Known& known = known_[triangle];
  const auto obstacle = static_cast<std::size_t>(run.obstacle);
  if (known.place != places_[obstacle]) return -std::numeric_limits<double>::infinity();
  double squared = 0.0;
  for (int k = 0; k < 3; ++k) {
    squared = std::max(squared, (x.col(run.nodes[k]) - known.at.col(k)).squaredNorm());
  }
  const double way = std::sqrt(squared), error = errors_[obstacle];
  return known.least - (error > 0.0 ? kSteepestDistance : 1.0) * way * (1.0 + kDistanceRounding) -
         2.0 * error;
}

double SampleRuns::measuredGap(std::size_t triangle, const Points& x,
                               const std::vector<PosedObstacle>& posed) const {
  const Run& run = triangles_[triangle];
  Known& known = known_[triangle];
  known.least = leastGap(run, x, posed);
  for (int k = 0; k < 3; ++k) known.at.col(k) = x.col(run.nodes[k]);
  known.place = places_[static_cast<std::size_t>(run.obstacle)];
  return known.least;
}

double SampleRuns::leastGap(const Run& run, const Points& x,
                            const std::vector<PosedObstacle>& posed) const {
  const auto obstacle = static_cast<std::size_t>(run.obstacle);
  const Mat3 corners = x(Eigen::all, run.nodes);
  return run.ball.leastGap(corners, offset_, posed[obstacle], errors_[obstacle]);
}

}  // namespace palpate::contact
