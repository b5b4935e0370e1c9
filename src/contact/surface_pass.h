// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "contact_surface.h"

namespace palpate::contact {

/// A moving contact surface; its nodes begin at column `first` of the points.
struct MovingSurface {
  std::shared_ptr<const ContactSurface> fixed;
  int first;
  std::vector<TriangleTree::Box> boxes;  ///< Boxes of the tree at the last search.

  Eigen::Ref<const Points> part(const Points& x) const {
    return x.middleCols(first, fixed->atRest().cols());
  }
};

/// Displacement of points since the last search: a common shift, and a bound of the rest [m].
struct Moved {
  Vec3 shift = Vec3::Zero();
  double rest = 0.0;
};

/// A sample and the nearest point of the other surface.
struct SurfaceTouch {
  int sample;
  int triangle = -1;
  TrianglePoint near;
  double gap;   ///< Signed distance [m], negative inside.
  Vec3 normal;  ///< Gradient of the gap by the sample, unit, outward of the other surface.
};

/// Kinematics of contact of one surface's samples with another surface, or itself.
class SurfacePass {
 public:
  /// `feels`: surface of the samples; `other`: the other surface, or the same for self-contact.
  /// @pre Both outlive this.
  SurfacePass(const MovingSurface* feels, const MovingSurface* other);

  const MovingSurface& feels() const { return *feels_; }
  const MovingSurface& other() const { return *other_; }
  bool self() const { return feels_ == other_; }
  /// Penetration of a sample at rest, >= 0 [m].
  double overlap(int sample) const { return overlaps_[static_cast<std::size_t>(sample)]; }
  int numCandidates() const { return static_cast<int>(candidates_.size()); }

  /// As SurfaceContact::search(). Skips samples that remain far after a displacement of `moved`
  /// [m], without the common shift, since the last search.
  /// @pre The boxes of both surfaces are those at x.
  void search(const Points& x, double way, double moved);

  /// Adds the nodes of candidates, of both surfaces, with repetition.
  void addNodes(double way, std::vector<int>* nodes) const;

  /// Calls visit(touch, sample) for all candidates with a gap below `reach` [m] at x.
  template <class Visit>
  void forTouches(const Points& x, const Moved& moved, double reach, const Visit& visit) const {
    for (const Candidate& c : candidates_) {
      if (c.gap - 2.0 * moved.rest >= reach) continue;
      SurfaceTouch touch;
      if (!measure(c, x, moved, &touch) || !(touch.gap < reach)) continue;
      visit(touch, feels_->fixed->samples()[static_cast<std::size_t>(c.sample)]);
    }
  }

  /// Position of a sample of `feels`; x: points of both [m].
  Vec3 position(const SurfaceSample& sample, const Points& x) const {
    Vec3 p = Vec3::Zero();
    for (int k = 0; k < 3; ++k) p += sample.weights[k] * x.col(feels_->first + sample.nodes[k]);
    return p;
  }

 private:
  struct Candidate {
    int sample, triangle;  // nearest triangle at the search
    double gap;            // gap at the search [m]
  };
  struct Near {
    double distance;
    int triangle;
    bool operator<(const Near& o) const {
      return std::make_pair(distance, triangle) < std::make_pair(o.distance, o.triangle);
    }
  };
  struct Clear {  // distance of a sample from the other surface, minus displacements since
    double distance = 0.0;  // [m]
    bool outside = false;   // certainly outside
    int triangle = -1;      // nearest
    bool holds(double gap, double depth) const { return distance > (outside ? gap : depth); }
  };
  struct Patch {  // consecutive samples of one triangle
    Eigen::Vector3i nodes;
    int begin, end;
  };

  void findOverlaps();
  bool mayFeel(const SurfaceSample& sample, const Vec3& P, int triangle) const;
  bool mayFeelAny(const Patch& patch, const TriangleTree::Box& box, double reach) const;
  bool isAtExcludedTriangle(const SurfaceSample& sample, const SurfaceTouch& touch) const;
  double distanceTo(int triangle, const Vec3& p, const Eigen::Ref<const Points>& x) const;
  template <class Allowed>
  Near nearest(const Vec3& p, const Eigen::Ref<const Points>& x,
               const std::vector<TriangleTree::Box>& boxes, const Moved& moved, Near best,
               const Allowed& allowed) const;
  void signTouch(const Vec3& p, const Eigen::Ref<const Points>& x, SurfaceTouch* touch) const;
  bool measure(const Candidate& c, const Points& x, const Moved& moved, SurfaceTouch* touch) const;
  bool allClear(const Patch& patch, double gap, double depth) const;
  void searchSample(int s, const Points& x, double way, double deepest);

  const MovingSurface *feels_, *other_;
  std::vector<Patch> patches_;
  std::vector<double> overlaps_;
  std::vector<Clear> clear_;  // of each sample
  double deepest_;            // largest depth of candidates [m]
  std::vector<Candidate> candidates_;
  TriangleTree::Box region_;  // box around the candidates
};

}  // namespace palpate::contact
