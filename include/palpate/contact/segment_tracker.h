// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::contact {

/// Intersection of a segment with a surface.
struct SegmentHit {
  int triangle;
  Vec3 weights;  ///< Barycentric coordinates, >= 0; one is 1 at a vertex, one is 0 on an edge.
  double part;   ///< Fraction of the segment from its begin to the intersection [-].
  bool inward;   ///< Whether the segment enters the body there.
};

/// Intersections of a segment with a moving surface [Castillo Leon 2011, sec. 7.4]. A tree of
/// bounding boxes finds them; a walk over neighbouring triangles follows them [Devillers, Pion,
/// Teillaud 2002, visibility walk]. Both use the same predicate, which is consistent across edges,
/// so no intersection falls between two triangles.
class SegmentTracker {
 public:
  /// Number of operations since construction.
  struct Counts {
    long queries = 0;  ///< Queries of the tree.
    long walks = 0;    ///< Walks over neighbours.
    long steps = 0;    ///< Edges crossed by walks.
    long lost = 0;     ///< Walks that found no intersection.
  };

  /// `X`: points at rest, 3 x n [m]; `triangles`: 3 x m, outward, m > 0.
  SegmentTracker(const Points& X, const Eigen::Matrix3Xi& triangles);
  ~SegmentTracker();
  SegmentTracker(const SegmentTracker&) = delete;
  SegmentTracker& operator=(const SegmentTracker&) = delete;

  /// Updates the tree to positions x, 3 x n [m].
  void fit(const Points& x);
  /// Finds all intersections at x, sorted by `part`, then by triangle. Every triangle at an edge or
  /// vertex has one.
  /// @pre fit(x).
  void find(const Points& x, const Vec3& begin, const Vec3& end, std::vector<SegmentHit>* hits);
  /// Follows the intersection of the segment's line from `triangle` over neighbours at x; `part` is
  /// outside [0, 1] beyond the ends. None where the line misses the surface or the walk leaves it.
  std::optional<SegmentHit> walk(const Points& x, const Vec3& begin, const Vec3& end, int triangle);

  const Counts& counts() const { return counts_; }
  const Eigen::Matrix3Xi& triangles() const { return triangles_; }

 private:
  struct Tree;
  const Eigen::Matrix3Xi triangles_;
  Eigen::Matrix3Xi neighbours_;  // across the edge from corner k to the next; -1: none or several
  std::unique_ptr<Tree> tree_;
  Counts counts_;
};

}  // namespace palpate::contact
