// SPDX-License-Identifier: GPL-3.0-or-later
// How far the tissue and the obstacles may go at once.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_candidates.h"
#include "face_points.h"

namespace palpate::contact {
namespace {

// In so many stages a fast ball goes through a cycle without its centre's getting behind the
// surface; of the way from which the surface comes back, so much at once does no harm.
constexpr double kCarefulStages = 8.0, kHarmless = 0.125;

// How far a point at `distance` [m] may come nearer to an obstacle of inscribed radius r before the
// next look: up to the surface, and half of what is left from there to the middle. With a smaller r
// it may go less far in.
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
  // A sample that is already in the middle must not bring the solve to a stand.
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
                     // A fast one may get behind the surface, which is then brought back.
                     const double deepest = std::max(0.5 * radius, FacePoints::kFollow * m.edge);
                     const double least = std::max(0.5 * radius, kHarmless * deepest);
                     const double deep = std::clamp(ways[b] / kCarefulStages, least, deepest);
                     double room = std::max(m.distance - radius, 0.0) + deep;
                     if (m.distance < 0.0) room = std::max(deep + m.distance, 0.25 * deep);
                     // A point that a soft contact holds there is behind it already, and is to stay
                     // near.
                     if (m.distance < -deep) room = std::max(room, 0.5 * (deepest + m.distance));
                     (*allowed)[b] = std::min((*allowed)[b], room);
                   });
}

}  // namespace palpate::contact
