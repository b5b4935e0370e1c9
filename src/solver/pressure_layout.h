// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/fem/stiffness.h"
#include "sliced_rows.h"

namespace palpate::solver {

/// Where the pressures of a VolumeStiffness lie in slices. One at most is at home at each node: its
/// row of B reaches no further than the node's row of K, so both are worked through together. It
/// lies where the node lies. The others (nodes between solids have several pressures) lie in slices
/// of their own behind those of the nodes.
class PressureLayout {
 public:
  PressureLayout() = default;
  PressureLayout(const fem::BlockMatrix& K, const fem::VolumeStiffness::Pattern& pattern,
                 const SliceOrder& nodes);

  int count() const { return static_cast<int>(position_.size()); }
  int numSlices() const { return node_slices_ + others_.numSlices(); }
  int position(int p) const { return position_[p]; }
  /// Pressure at home at a node, or -1.
  int atHome(int node) const { return at_home_[node]; }

  /// The others: pressure `numbers()[k]` is number k of them.
  const SliceOrder& others() const { return others_; }
  const std::vector<int>& numbers() const { return numbers_; }
  /// Slice where they begin.
  int othersBegin() const { return node_slices_; }

 private:
  void assignPositions(const fem::BlockMatrix& K, const fem::VolumeStiffness::Pattern& pattern);

  int node_slices_ = 0;
  std::vector<int> position_, at_home_, numbers_;
  SliceOrder others_;
};

}  // namespace palpate::solver
