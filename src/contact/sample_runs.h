// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/surface_samples.h"
#include "sample_ball.h"

namespace palpate::contact {

/// A sample of the surface that may touch a posed obstacle.
struct SampleCandidate {
  int sample, obstacle;
};

/// Candidates that follow one another and lie close together on a triangle: of a triangle, and of
/// parts of it. Where the middle of such a run is far from the obstacle all of the run is, and
/// nobody need look at its samples; and what was far and has not gone as far since, while the
/// obstacle stood still, is not even asked.
class SampleRuns {
 public:
  struct Run {
    Eigen::Vector3i nodes;  ///< Of the triangle.
    int obstacle;
    int begin, end;             ///< Of its candidates.
    int first_part, last_part;  ///< Of a triangle, [first, last).
    SampleBall ball;
  };

  /// Of these candidates; `largest_offset` [m]: of a sample from its triangle.
  void build(const std::vector<SurfaceSample>& samples,
             const std::vector<SampleCandidate>& candidates,
             const std::vector<PosedObstacle>& posed, double largest_offset);

  /// visit(candidate's index), in order, of all runs that are not far(run, least): `least` is a
  /// gap [m] below those of all of its samples at x, or not a number.
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
  struct Known {  // of a triangle's run, where it was last measured
    double least;
    Mat3 at;    // its corners [m],
    int place;  // and which of the obstacle's places it was
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
  mutable std::vector<Pose> poses_;  // of the obstacles when they were last looked at,
  mutable std::vector<int> places_;  // and how many others before
};

}  // namespace palpate::contact
