// SPDX-License-Identifier: GPL-3.0-or-later
#include "pressure_layout.h"

#include <algorithm>

namespace palpate::solver {
namespace {

bool reachesAll(const fem::BlockMatrix& K, int i, const int* begin, const int* end) {
  return std::all_of(begin, end, [&](int j) { return K.find(i, j) >= 0; });
}

}  // namespace

// Chooses the free node with the shortest row that covers the pressure's row. In a body of one
// solid, rows of B are as long as those of their nodes, and all pressures find a home.
void PressureLayout::assignPositions(const fem::BlockMatrix& K,
                                     const fem::VolumeStiffness::Pattern& pattern) {
  const auto length = [&](int i) { return K.rowEnd(i) - K.rowBegin(i); };
  for (int p = 0; p < count(); ++p) {
    const int* begin = pattern.node.data() + pattern.start[p];
    const int* end = pattern.node.data() + pattern.start[p + 1];
    int home = -1;
    for (const int* i = begin; i < end; ++i) {
      if (at_home_[*i] < 0 && (home < 0 || length(*i) < length(home)) &&
          reachesAll(K, *i, begin, end)) {
        home = *i;
      }
    }
    if (home < 0) {
      numbers_.push_back(p);
    } else {
      at_home_[home] = p;
    }
  }
}

PressureLayout::PressureLayout(const fem::BlockMatrix& K,
                               const fem::VolumeStiffness::Pattern& pattern,
                               const SliceOrder& nodes)
    : node_slices_(nodes.numSlices()),
      position_(pattern.start.size() - 1),
      at_home_(static_cast<std::size_t>(nodes.count()), -1) {
  assignPositions(K, pattern);
  for (int i = 0; i < nodes.count(); ++i) {
    if (at_home_[i] >= 0) position_[at_home_[i]] = nodes.position(i);
  }
  std::vector<int> lengths;
  for (int p : numbers_) lengths.push_back(pattern.start[p + 1] - pattern.start[p]);
  others_ = SliceOrder(lengths);
  for (int k = 0; k < others_.count(); ++k) {
    position_[numbers_[k]] = kSlice * node_slices_ + others_.position(k);
  }
}

}  // namespace palpate::solver
