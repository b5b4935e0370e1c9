// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/contact/signed_distance.h"

namespace palpate::contact {
namespace {

constexpr int kPart = 8;  // candidates
// A sampled distance may be steeper than 1 between the points where it is exact.
constexpr double kSteepest = 1.25;
constexpr double kRounding = 1e-9;

}  // namespace

void SampleRuns::build(const std::vector<SurfaceSample>& samples,
                       const std::vector<SampleCandidate>& candidates,
                       const std::vector<PlacedObstacle>& placed, double largest_offset) {
  triangles_.clear();
  parts_.clear();
  errors_.clear();
  offset_ = largest_offset;
  for (const PlacedObstacle& obstacle : placed) {
    errors_.push_back(distanceError(*obstacle.obstacle().geometry));
  }
  const int count = static_cast<int>(candidates.size());
  for (int begin = 0, end = 0; begin < count; begin = end) {
    const SampleCandidate& first = candidates[static_cast<std::size_t>(begin)];
    const Eigen::Vector3i nodes = samples[static_cast<std::size_t>(first.sample)].nodes;
    const auto same = [&](const SampleCandidate& c) {
      return c.obstacle == first.obstacle &&
             samples[static_cast<std::size_t>(c.sample)].nodes == nodes;
    };
    for (end = begin + 1; end < count && same(candidates[static_cast<std::size_t>(end)]);) ++end;
    Run run{nodes, first.obstacle, begin, end, static_cast<int>(parts_.size()), 0, Vec3::Zero(), 0};
    for (int at = begin; at < end; at += kPart) {
      Run part = run;
      part.begin = at;
      part.end = std::min(at + kPart, end);
      enclose(samples, candidates, &part);
      parts_.push_back(part);
    }
    run.last_part = static_cast<int>(parts_.size());
    enclose(samples, candidates, &run);
    triangles_.push_back(run);
  }
  known_.assign(triangles_.size(), {0.0, Mat3::Zero(), -1});
  poses_.clear();
}

void SampleRuns::lookAt(const std::vector<PlacedObstacle>& placed) const {
  if (poses_.size() != placed.size()) {
    poses_.clear();
    for (const PlacedObstacle& obstacle : placed) poses_.push_back(obstacle.obstacle().X_WG_end);
    places_.assign(placed.size(), places_.empty() ? 0 : places_.front() + 1);
    return;
  }
  for (std::size_t b = 0; b < placed.size(); ++b) {
    const Pose& now = placed[b].obstacle().X_WG_end;
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
  return known.least - (error > 0.0 ? kSteepest : 1.0) * way * (1.0 + kRounding) - 2.0 * error;
}

double SampleRuns::measuredGap(std::size_t triangle, const Points& x,
                               const std::vector<PlacedObstacle>& placed) const {
  const Run& run = triangles_[triangle];
  Known& known = known_[triangle];
  known.least = leastGap(run, x, placed);
  for (int k = 0; k < 3; ++k) known.at.col(k) = x.col(run.nodes[k]);
  known.place = places_[static_cast<std::size_t>(run.obstacle)];
  return known.least;
}

// Between points of a triangle with weights v and w there is at most half of sum |v - w| of its
// longest edge.
void SampleRuns::enclose(const std::vector<SurfaceSample>& samples,
                         const std::vector<SampleCandidate>& candidates, Run* run) {
  const auto weights = [&](int c) -> const Vec3& {
    return samples[static_cast<std::size_t>(candidates[static_cast<std::size_t>(c)].sample)]
        .weights;
  };
  Vec3 low = weights(run->begin), high = low;
  for (int c = run->begin; c < run->end; ++c) {
    low = low.cwiseMin(weights(c));
    high = high.cwiseMax(weights(c));
  }
  run->middle = 0.5 * (low + high);
  run->middle /= run->middle.sum();
  run->spread = 0.0;
  for (int c = run->begin; c < run->end; ++c) {
    run->spread = std::max(run->spread, 0.5 * (weights(c) - run->middle).lpNorm<1>());
  }
}

double SampleRuns::leastGap(const Run& run, const Points& x,
                            const std::vector<PlacedObstacle>& placed) const {
  const Vec3 a = x.col(run.nodes[0]), b = x.col(run.nodes[1]), c = x.col(run.nodes[2]);
  const double longest =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  const double radius = run.spread * longest + offset_;
  const auto obstacle = static_cast<std::size_t>(run.obstacle);
  const double gap =
      placed[obstacle].gap(run.middle[0] * a + run.middle[1] * b + run.middle[2] * c);
  const double error = errors_[obstacle];
  const double steepest = error > 0.0 ? kSteepest : 1.0;
  return gap - steepest * radius - 2.0 * error - kRounding * (std::abs(gap) + radius);
}

}  // namespace palpate::contact
