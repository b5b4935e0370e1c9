// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::contact {

/// Where a segment crosses a surface.
struct SegmentHit {
  int triangle;
  Vec3 weights;  ///< Barycentric, >= 0: of a vertex one of them is 1, on an edge one is 0.
  double part;   ///< Of the way from the segment's begin to its end.
  bool inward;   ///< On that way it goes in.
};

/// The crossings of a segment with a surface that moves [Castillo Leon 2011, sec. 7.4]: found by a
/// tree of boxes, and from then on followed from triangle to triangle over their edges, each to the
/// side on which the segment's line passes [Devillers, Pion, Teillaud 2002, visibility walk]. Tree
/// and walk ask triangles by the same arithmetic, which gives both triangles of an edge the same
/// number: nothing slips between them.
class SegmentTracker {
 public:
  /// What was asked of it since it was made.
  struct Counts {
    long queries = 0;  ///< Of the tree,
    long walks = 0;    ///< of neighbours,
    long steps = 0;    ///< over so many edges,
    long lost = 0;     ///< and of the walks those that did not arrive.
  };

  /// `X`: points at rest, 3 x n [m]; `triangles`: 3 x m, outward, m > 0.
  SegmentTracker(const Points& X, const Eigen::Matrix3Xi& triangles);
  ~SegmentTracker();
  SegmentTracker(const SegmentTracker&) = delete;
  SegmentTracker& operator=(const SegmentTracker&) = delete;

  /// Fits the tree to the surface at x, 3 x n [m].
  void fit(const Points& x);
  /// All crossings with the surface at x, to which the tree was fitted, by `part`, and of one place
  /// by triangle. On an edge or a vertex every triangle there has one.
  void find(const Points& x, const Vec3& begin, const Vec3& end, std::vector<SegmentHit>* hits);
  /// Where the line through the segment crosses the surface at x, as neighbours of `triangle` lead
  /// to it; `part` is below 0 or above 1 beyond the ends. None if the line passes the surface there
  /// or the surface turns away on the way.
  std::optional<SegmentHit> walk(const Points& x, const Vec3& begin, const Vec3& end, int triangle);

  const Counts& counts() const { return counts_; }
  const Eigen::Matrix3Xi& triangles() const { return triangles_; }

 private:
  struct Tree;
  const Eigen::Matrix3Xi triangles_;
  Eigen::Matrix3Xi neighbours_;  // beyond the edge from corner k to the next; -1: not one triangle
  std::unique_ptr<Tree> tree_;
  Counts counts_;
};

}  // namespace palpate::contact
