// SPDX-License-Identifier: GPL-3.0-or-later
// Search for candidates: samples of the surface, and tool balls on its triangles.
#include <algorithm>

#include "face_points.h"
#include "palpate/contact/contact_potential.h"
#include "palpate/contact/signed_distance.h"
#include "sample_runs.h"

namespace palpate::contact {

void ContactPotential::setSkips(bool distant, bool inactive) {
  skip_distant_ = distant;
  skip_inactive_ = inactive;
  if (faces_) faces_->setSkip(inactive);
}

void ContactPotential::setObstacles(const std::vector<Obstacle>& obstacles) {
  bool same = posed_.size() == obstacles.size();
  for (std::size_t b = 0; same && b < obstacles.size(); ++b) {
    same = posed_[b].obstacle().geometry == obstacles[b].geometry;
  }
  if (!same) posed_.clear();
  for (std::size_t b = 0; b < obstacles.size(); ++b) {
    if (same) {
      posed_[b].move(obstacles[b]);
    } else {
      posed_.emplace_back(obstacles[b], margin_);
    }
  }
  if (!faces_) return;
  if (same) {
    faces_->moveObstacles();
  } else {
    faces_->setObstacles(posed_);
  }
}

void ContactPotential::findCandidates(const Points& x, const std::vector<double>& reach) {
  candidates_.clear();
  if (faces_) faces_->clear();
  for (int b = 0; b < numObstacles(); ++b) {
    if (addSamples(x, b, reach[b])) faces_->findCandidates(x, posed_, b, reach[b]);
  }
  runs_->build(samples_, candidates_, posed_, largest_offset_);
}

// Patches [first, end) with the samples for an obstacle.
std::pair<int, int> ContactPotential::patchesFor(const PosedObstacle& posed) const {
  if (!for_anatomy_) return {0, numPatches()};
  if (posed.obstacle().owner.isInstrument()) return {0, for_anatomy_->patch};
  return {for_anatomy_->patch, numPatches()};
}

// Whether the sample spacing is too coarse for the obstacle near it.
bool ContactPotential::addSamples(const Points& x, int obstacle, double reach) {
  bool coarse = faces_ && nodes_only_;
  const PosedObstacle& posed = posed_[obstacle];
  const instrument::Geometry& geometry = *posed.obstacle().geometry;
  const double far = reach + posed.margin(), ball = boundingRadius(geometry) + far;
  const double error = distanceError(geometry);
  const auto [first, end] = patchesFor(posed);
  for (int k = first; k < end; ++k) {
    const Patch& patch = patches_[k];
    if (skip_distant_) {
      // The distance changes at most by the displacement: far triangles are skipped as a whole.
      const Vec3 corner = x.col(patch.nodes[0]);
      const double size = std::max((x.col(patch.nodes[1]) - corner).norm(),
                                   (x.col(patch.nodes[2]) - corner).norm());
      const Vec3 corner_G = posed.toObstacle(corner);
      if (corner_G.norm() > ball + size) continue;
      if (signedDistanceValue(geometry, corner_G) > far + size) continue;
    }
    if (patch.triangle >= 0) {
      const double spacing = faces_->sampleSpacing(patch.triangle, x);
      coarse = coarse || faces_->usesBalls(obstacle, spacing);
      if (faces_->usesBallsOnly(obstacle, spacing)) continue;
    }
    const Mat3 corners = x(Eigen::all, patch.nodes);
    const bool in_parts = skip_distant_ && patch.last_part - patch.first_part > 1;
    for (int p = patch.first_part; p < patch.last_part; ++p) {
      const SamplePart& part = parts_[static_cast<std::size_t>(p)];
      const SampleBall& around = part.ball;
      if (in_parts && around.leastGap(corners, largest_offset_, posed, error) > reach) continue;
      for (int s = part.begin; s < part.end; ++s) {
        if (skip_distant_ && posed.gap(samples_[s].position(x)) > reach) continue;
        candidates_.push_back({s, obstacle});
      }
    }
  }
  return coarse;
}

bool ContactPotential::hasCandidates(int obstacle) const {
  return std::any_of(candidates_.begin(), candidates_.end(),
                     [&](const SampleCandidate& c) { return c.obstacle == obstacle; }) ||
         (faces_ && faces_->hasCandidates(obstacle));
}

int ContactPotential::numCandidates() const {
  return static_cast<int>(candidates_.size()) + (faces_ ? faces_->numCandidates() : 0);
}

int ContactPotential::numDistant() const {
  int all = 0;
  for (const PosedObstacle& posed : posed_) {
    const auto [first, end] = patchesFor(posed);
    if (first < end) all += patches_[end - 1].end - patches_[first].begin;
  }
  return all - static_cast<int>(candidates_.size());
}

void ContactPotential::candidateNodes(std::vector<int>* nodes) const {
  nodes->clear();
  // Consecutive candidates share nodes.
  Eigen::Vector3i last = Eigen::Vector3i::Constant(-1);
  Eigen::Array3i taken = Eigen::Array3i::Zero();
  for (const SampleCandidate& c : candidates_) {
    const SurfaceSample& s = samples_[c.sample];
    if (s.nodes != last) taken.setZero();
    last = s.nodes;
    for (int k = 0; k < 3; ++k) {
      if (taken[k] || s.weights[k] == 0.0) continue;
      taken[k] = 1;
      nodes->push_back(s.nodes[k]);
    }
  }
  if (faces_) faces_->forNodes([&](int node) { nodes->push_back(node); });
  std::sort(nodes->begin(), nodes->end());
  nodes->erase(std::unique(nodes->begin(), nodes->end()), nodes->end());
}

}  // namespace palpate::contact
