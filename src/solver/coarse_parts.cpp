// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_parts.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "chunks.h"

namespace palpate::solver {
namespace {

static_assert(kWindow == kSlice * Chunks::kSlices);

/// A slice's weights for a group.
struct Piece {
  int group, slice, lane;
  double weight;
  bool operator<(const Piece& b) const {
    return std::tie(group, slice, lane) < std::tie(b.group, b.slice, b.lane);
  }
};

}  // namespace

CoarseParts::CoarseParts(const CoarseGroups& groups, const Points& points, const SliceOrder& nodes)
    : of_window{0},
      pieces{0},
      of_slice{0},
      arm(static_cast<std::size_t>(3 * kSlice) * nodes.numSlices(), 0.0F) {
  for (int window = 0; window < Chunks::number(nodes.numSlices()); ++window) {
    addWindow(window, groups, nodes);
    placeArms(window, groups, points, nodes);
  }
}

// Lists the groups of the window's nodes and of its slices.
void CoarseParts::addWindow(int window, const CoarseGroups& groups, const SliceOrder& nodes) {
  std::vector<Piece> all;
  const int end = std::min(kWindow * (window + 1), nodes.count());
  for (int position = kWindow * window; position < end; ++position) {
    const int i = nodes.at(position);
    for (int q = kGroupsOfANode * i; q < kGroupsOfANode * (i + 1); ++q) {
      if (groups.weight[q] == 0.0) continue;
      const int at = position % kWindow;
      all.push_back({groups.group[q], at / kSlice, at % kSlice, groups.weight[q]});
    }
  }
  std::sort(all.begin(), all.end());
  std::array<std::vector<std::pair<int, int>>, kWindow / kSlice> of_slices;  // piece, part
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Piece& piece = all[k];
    const bool new_part = k == 0 || piece.group != all[k - 1].group;
    if (new_part) part.push_back({piece.group, Vec3::Zero(), 1.0});
    if (new_part && k > 0) pieces.push_back(static_cast<int>(slice.size()));
    if (new_part || piece.slice != all[k - 1].slice) {
      of_slices[piece.slice].emplace_back(slice.size(), part.size() - 1);
      slice.push_back(piece.slice);
      weights.resize(weights.size() + kSlice, 0.0F);
    }
    weights[weights.size() - kSlice + piece.lane] = static_cast<float>(piece.weight);
  }
  pieces.push_back(static_cast<int>(slice.size()));
  of_window.push_back(static_cast<int>(part.size()));
  for (const auto& pieces_of : of_slices) {
    for (const auto& [number, of_part] : pieces_of) {
      piece_of_slice.push_back(number);
      part_of_slice.push_back(of_part);
    }
    of_slice.push_back(static_cast<int>(piece_of_slice.size()));
  }
}

// Arms from the centre of a window, in units of its radius.
void CoarseParts::placeArms(int window, const CoarseGroups& groups, const Points& points,
                            const SliceOrder& nodes) {
  const int begin = kWindow * window, end = std::min(begin + kWindow, nodes.count());
  Vec3 middle = Vec3::Zero();
  for (int position = begin; position < end; ++position) middle += points.col(nodes.at(position));
  middle /= end - begin;
  double radius = 0.0;
  for (int position = begin; position < end; ++position) {
    radius = std::max(radius, (points.col(nodes.at(position)) - middle).norm());
  }
  for (int position = begin; position < end; ++position) {
    const int i = nodes.at(position);
    const Vec3 unit_arm = radius > 0.0 ? Vec3((points.col(i) - middle) / radius) : Vec3::Zero();
    for (int c = 0; c < 3; ++c) {
      arm[nodes.offset(i, 3) + kSlice * c] = static_cast<float>(unit_arm[c]);
    }
  }
  for (int k = of_window[window]; k < of_window[window + 1]; ++k) {
    const int g = part[k].group;
    const double unit = groups.radius[g] > 0.0 ? 1.0 / groups.radius[g] : 0.0;
    part[k].shift = unit * (middle - groups.middle.col(g));
    part[k].scale = unit * radius;
  }
}

}  // namespace palpate::solver
