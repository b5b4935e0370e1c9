// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds of steps of tissue and obstacles.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_candidates.h"
#include "face_points.h"

namespace palpate::contact {
namespace {

// Stages of a fast ball in a cycle with its centre in front of the surface [-]; harmless fraction
// of the recoverable depth [-].
constexpr double kCarefulStages = 8.0, kHarmless = 0.125;

// Allowed approach [m] of a point at `distance` [m] to an obstacle of inscribed radius r [m]: to
// the surface, and half-way to the middle.
double allowedApproach(double distance, double r) {
  return distance >= 0.0 ? distance + 0.5 * r : 0.5 * std::max(distance + r, 0.0);
}

}  // namespace

double ContactPotential::maxStep(const Points& x, const Points& d) const {
  double largest = 1.0;
  const auto goesLess = [&](const SampleRuns::Run& run, double least) {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, d.col(run.nodes[k]).squaredNorm());
    return least >= 0.0 && std::sqrt(longest) * largest <= least;
  };
  forCandidates(x, goesLess, [&](const SampleCandidate& c) {
    const PosedObstacle& obstacle = posed_[c.obstacle];
    const Vec3 motion = samples_[c.sample].of(d);
    const double length = motion.norm();
    Touch touch;
    obstacle.measureGap(samples_[c.sample].position(x), &touch);
    const double allowed = allowedApproach(touch.gap, obstacle.radius());
    if (length * largest <= allowed) return;
    obstacle.measureFrame(&touch);
    const double approach = -touch.normal_W.dot(motion);
    if (approach * largest > allowed) largest = allowed / approach;
  });
  if (faces_) largest = faces_->maxStep(x, d, posed_, largest);
  // A sample at the middle must not stop the solve.
  return std::max(largest, 1e-3);
}

void ContactPotential::allowedMotions(const Points& x, const std::vector<double>& ways,
                                      std::vector<double>* allowed) const {
  allowed->assign(posed_.size(), std::numeric_limits<double>::infinity());
  const auto isFarther = [&](const SampleRuns::Run& run, double least) {
    return least >= (*allowed)[static_cast<std::size_t>(run.obstacle)];
  };
  forCandidates(x, isFarther, [&](const SampleCandidate& c) {
    const PosedObstacle& obstacle = posed_[c.obstacle];
    const SurfaceSample& s = samples_[c.sample];
    const double distance = obstacle.gap(s.position(x));
    double& least = (*allowed)[c.obstacle];
    if (distance >= least) return;
    const double size = std::min(obstacle.radius(), s.meanEdge(x));
    least = std::min(least, allowedApproach(distance, size));
  });
  if (!faces_) return;
  faces_->forBalls(x, posed_,
                   [&](int obstacle, double radius, const FacePoints::BallTrianglePair& m) {
                     const auto b = static_cast<std::size_t>(obstacle);
                     // The surface returns where a fast ball is behind it.
                     const double deepest = std::max(0.5 * radius, FacePoints::kFollow * m.edge);
                     const double least = std::max(0.5 * radius, kHarmless * deepest);
                     const double deep = std::clamp(ways[b] / kCarefulStages, least, deepest);
                     double room = std::max(m.distance - radius, 0.0) + deep;
                     if (m.distance < 0.0) room = std::max(deep + m.distance, 0.25 * deep);
                     // Soft contact may hold a ball behind the surface; it stays near.
                     if (m.distance < -deep) room = std::max(room, 0.5 * (deepest + m.distance));
                     (*allowed)[b] = std::min((*allowed)[b], room);
                   });
}

}  // namespace palpate::contact
