// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "palpate/contact/segment_tracker.h"
#include "prescribed_displacements.h"
#include "tied_point.h"

namespace palpate::tissue {

/// Contact with a segment as tool [Castillo Leon 2011, sec. 7.4, 7.5]: the axis of the first near
/// capsule or cylinder of an instrument, with its caps. The surface point at the intersection is
/// held on the segment, and its reaction is the tool's force.
///
/// The end inside the body is the tip; the surface point on the segment moves to the tip and is
/// held in all components, as in the source. The point follows the intersection of the segment's
/// line with the surface by a walk over triangles, or by the tree where the walk fails. A segment
/// through the whole body, with both ends outside, moves its entry point while in compression.
///
/// In contrast to the source, shape functions constrain the point (TiedPoint), not each node. It is
/// released in tension, or without an intersection within a mean edge ahead of the tip. Points with
/// a held component are not touched.
class SegmentContact final : public PrescribedDisplacements {
 public:
  explicit SegmentContact(FemBody* body);

  void clear() override;
  void keep() override;
  void goBack() override;
  void save(StateWriter* to) const override;
  void restore(StateReader* from) override;

  double nextStage(const Points& x, double s, double end) override;
  void beginStage(const Points& x, double s, double end) override;
  bool holdWhatPenetrates(const Points& x) override;
  bool release(const Points& x, const Points& gradient) override;
  void moves(const Points& x, Points* move) const override;

  bool holds() const override { return hold_.has_value(); }
  const fem::FreeMask& free() const override { return body_.free; }
  double unbalanced(const Points& gradient) const override;
  double nodalNorm(const Points& gradient) const override { return tie_.nodalNorm(gradient); }
  void report(const Points& x, const Points& gradient, TissueStep* out) const override;
  void addWork(TissueStep* out) const override;
  void reduce(Eigen::SparseMatrix<double>* A) const override { tie_.reduce(A); }
  void reduce(Points* right) const override { tie_.reduce(right); }
  void expand(Points* step) const override { tie_.expand(step); }

  const contact::SegmentTracker::Counts& counts() const { return tracker_.counts(); }

 private:
  struct Hold {
    int number;  // Obstacle::number
    int triangle;
    Vec3 weights;
    double part;  // of the segment, where it holds: 0 or 1 is the tip
  };
  struct Segment {
    Vec3 begin, end;
    Vec3 at(double part) const { return begin + part * (end - begin); }
  };
  int findTool() const;
  Segment placed(int obstacle, double s) const;
  void hold(const std::optional<Hold>& hold);
  void follow(const Points& x);
  std::optional<contact::SegmentHit> entryOf(const Points& x, const Segment& tool);
  std::optional<Hold> choose(const Points& x);
  Vec3 outward(const Points& x, int triangle) const;
  Vec3 position(const Points& x) const;

  FemBody& body_;
  contact::SegmentTracker tracker_;
  double mean_edge_;  // of the surface at rest [m]
  std::optional<Hold> hold_, kept_;
  contact::SegmentTracker::Counts counted_;  // at keep()
  TiedPoint tie_;
  int tool_ = -1;           // index among near obstacles
  Segment was_{}, now_{};   // at begin and end of the stage
  bool released_ = false;   // in this stage
  mutable Points rest_of_;  // scratch
  std::vector<contact::SegmentHit> hits_;
};

}  // namespace palpate::tissue
