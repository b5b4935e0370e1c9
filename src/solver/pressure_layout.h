// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/fem/stiffness.h"
#include "sliced_rows.h"

namespace palpate::solver {

/// Positions of the pressures of a VolumeStiffness in slices. At most one pressure has its home at
/// each node: its row of B reaches no further than the node's row of K, so both are processed
/// together, at the node's position. The others (several pressures per node between solids) have
/// slices of their own after the nodes'.
class PressureLayout {
 public:
  PressureLayout() = default;
  PressureLayout(const fem::BlockMatrix& K, const fem::VolumeStiffness::Pattern& pattern,
                 const SliceOrder& nodes);

  int count() const { return static_cast<int>(position_.size()); }
  int numSlices() const { return node_slices_ + others_.numSlices(); }
  int position(int p) const { return position_[p]; }
  /// Pressure with home at a node, or -1.
  int atHome(int node) const { return at_home_[node]; }

  /// Pressures without home: number k of them is pressure `numbers()[k]`.
  const SliceOrder& others() const { return others_; }
  const std::vector<int>& numbers() const { return numbers_; }
  /// Their first slice.
  int othersBegin() const { return node_slices_; }

 private:
  void assignPositions(const fem::BlockMatrix& K, const fem::VolumeStiffness::Pattern& pattern);

  int node_slices_ = 0;
  std::vector<int> position_, at_home_, numbers_;
  SliceOrder others_;
};

}  // namespace palpate::solver
