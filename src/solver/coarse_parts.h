// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "aligned_vector.h"
#include "coarse_groups.h"

namespace palpate::solver {

/// Layout of groups for the kernels: their parts in windows, and the pieces of parts in slices, see
/// PcgCoarse.
struct CoarseParts {
  struct Part {
    int group;
    Vec3 shift;    ///< From the group's centre to the window's, over the group's radius.
    double scale;  ///< Radius of the window over that of the group.
  };

  CoarseParts(const CoarseGroups& groups, const Points& points, const SliceOrder& nodes);

  std::vector<Part> part;
  std::vector<int> of_window, pieces, slice, of_slice, piece_of_slice, part_of_slice;
  AlignedVector<float> weights, arm;

 private:
  void addWindow(int window, const CoarseGroups& groups, const SliceOrder& nodes);
  void placeArms(int window, const CoarseGroups& groups, const Points& points,
                 const SliceOrder& nodes);
};

}  // namespace palpate::solver
