// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/surface_samples.h"
#include "sample_ball.h"

namespace palpate::contact {

/// A candidate: a sample and a posed obstacle.
struct SampleCandidate {
  int sample, obstacle;
};

/// Hierarchy of candidates for skipping: runs of consecutive candidates of a triangle, and of its
/// parts. A far run is skipped as a whole, without a new distance while it has moved less than its
/// gap and the obstacle is at rest.
class SampleRuns {
 public:
  struct Run {
    Eigen::Vector3i nodes;  ///< Corners of the triangle.
    int obstacle;
    int begin, end;             ///< Range of candidates.
    int first_part, last_part;  ///< Range [first, last) of parts of a triangle.
    SampleBall ball;
  };

  /// Builds the runs of `candidates`; `largest_offset`: of a sample from its triangle [m].
  void build(const std::vector<SurfaceSample>& samples,
             const std::vector<SampleCandidate>& candidates,
             const std::vector<PosedObstacle>& posed, double largest_offset);

  /// Calls visit(candidate index), in order, for all runs except far(run, least), with `least` a
  /// lower bound of the run's gaps at x [m], or NaN.
  template <class Far, class Visit>
  void forEach(const Points& x, const std::vector<PosedObstacle>& posed, const Far& far,
               const Visit& visit) const {
    lookAt(posed);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Run& run = triangles_[t];
      if (far(run, knownGap(t, x)) || far(run, measuredGap(t, x, posed))) continue;
      for (int p = run.first_part; p < run.last_part; ++p) {
        const Run& part = parts_[static_cast<std::size_t>(p)];
        const bool whole = run.last_part - run.first_part == 1;
        if (!whole && far(part, leastGap(part, x, posed))) continue;
        for (int c = part.begin; c < part.end; ++c) visit(c);
      }
    }
  }

 private:
  struct Known {  // of a triangle's run, at the last measurement
    double least;
    Mat3 at;    // corners [m]
    int place;  // index of the obstacle's pose
  };
  void lookAt(const std::vector<PosedObstacle>& posed) const;
  double knownGap(std::size_t triangle, const Points& x) const;
  double measuredGap(std::size_t triangle, const Points& x,
                     const std::vector<PosedObstacle>& posed) const;
  double leastGap(const Run& run, const Points& x, const std::vector<PosedObstacle>& posed) const;

  std::vector<Run> triangles_, parts_;
  std::vector<double> errors_;  // of the obstacles' distances, see distanceError() [m]
  double offset_ = 0.0;
  mutable std::vector<Known> known_;
  mutable std::vector<Pose> poses_;  // last poses of the obstacles
  mutable std::vector<int> places_;  // number of earlier poses
};

}  // namespace palpate::contact
