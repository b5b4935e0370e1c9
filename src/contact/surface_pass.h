// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "contact_surface.h"

namespace palpate::contact {

/// A surface as it moves: its nodes are those of a body, which begin at `first`.
struct MovingSurface {
  std::shared_ptr<const ContactSurface> fixed;
  int first;
  std::vector<TriangleTree::Box> boxes;  ///< Of its tree, where it was searched last.

  Eigen::Ref<const Points> part(const Points& x) const {
    return x.middleCols(first, fixed->atRest().cols());
  }
};

/// How far points are from where they were searched: a shift of all, and at most so far beside it
/// [m].
struct Moved {
  Vec3 shift = Vec3::Zero();
  double rest = 0.0;
};

/// A sample and what is nearest to it of the other surface.
struct SurfaceTouch {
  int sample;
  int triangle = -1;
  TrianglePoint near;
  double gap;   ///< Signed distance [m], negative inside.
  Vec3 normal;  ///< Its gradient by the sample: unit, out of the other surface.
};

/// Samples of one surface against another one, or against itself: geometry alone.
class SurfacePass {
 public:
  /// `feels` and `other`, the same one twice for a surface with itself, outlive this.
  SurfacePass(const MovingSurface* feels, const MovingSurface* other);

  const MovingSurface& feels() const { return *feels_; }
  const MovingSurface& other() const { return *other_; }
  bool self() const { return feels_ == other_; }
  /// By how much a sample is inside at rest, >= 0 [m].
  double overlap(int sample) const { return overlaps_[static_cast<std::size_t>(sample)]; }
  int numCandidates() const { return static_cast<int>(candidates_.size()); }

  /// See SurfaceContact::search(). The boxes of both surfaces are those at x, where no point is
  /// farther than `moved` [m] from where it was at the last search, but for a shift of all: samples
  /// that were so far away that they still are none are not looked at.
  void search(const Points& x, double way, double moved);

  /// The nodes that gaps of candidates depend on, those of both surfaces, some more than once.
  void addNodes(double way, std::vector<int>* nodes) const;

  /// visit(touch, sample) of all candidates whose gap at x is less than `reach` [m].
  template <class Visit>
  void forTouches(const Points& x, const Moved& moved, double reach, const Visit& visit) const {
    for (const Candidate& c : candidates_) {
      if (c.gap - 2.0 * moved.rest >= reach) continue;
      SurfaceTouch touch;
      if (!measure(c, x, moved, &touch) || !(touch.gap < reach)) continue;
      visit(touch, feels_->fixed->samples()[static_cast<std::size_t>(c.sample)]);
    }
  }

  /// Of one of `feels`, in the points of both.
  Vec3 position(const SurfaceSample& sample, const Points& x) const {
    Vec3 p = Vec3::Zero();
    for (int k = 0; k < 3; ++k) p += sample.weights[k] * x.col(feels_->first + sample.nodes[k]);
    return p;
  }

 private:
  struct Candidate {
    int sample, triangle;  // the nearest one where it was searched
    double gap;            // there
  };
  struct Near {
    double distance;
    int triangle;
    bool operator<(const Near& o) const {
      return std::make_pair(distance, triangle) < std::make_pair(o.distance, o.triangle);
    }
  };
  struct Clear {  // how far a sample was from the other surface, less what both have moved since
    double distance = 0.0;  // [m]
    bool outside = false;   // of it, for sure
    int triangle = -1;      // that was the nearest
    bool holds(double gap, double depth) const { return distance > (outside ? gap : depth); }
  };
  struct Patch {  // samples of one triangle, which follow one another
    Eigen::Vector3i nodes;
    int begin, end;
  };

  void findOverlaps();
  bool mayFeel(const SurfaceSample& sample, const Vec3& P, int triangle) const;
  bool mayFeelAny(const Patch& patch, const TriangleTree::Box& box, double reach) const;
  bool isBorder(const SurfaceSample& sample, const SurfaceTouch& touch) const;
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
  double deepest_;            // that is found [m]
  std::vector<Candidate> candidates_;
  TriangleTree::Box region_;  // around them
};

}  // namespace palpate::contact
