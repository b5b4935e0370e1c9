// SPDX-License-Identifier: GPL-3.0-or-later
#include "sliced_rows.h"

#include <algorithm>
#include <numeric>

namespace palpate::solver {

SliceOrder::SliceOrder(const std::vector<int>& lengths, const std::vector<int>& order)
    : at_((lengths.size() + kSlice - 1) / kSlice * kSlice, -1),
      position_(lengths.size()),
      rank_(lengths.size()) {
  const auto count = static_cast<std::ptrdiff_t>(lengths.size());
  if (order.empty()) {
    std::iota(at_.begin(), at_.begin() + count, 0);
  } else {
    std::copy(order.begin(), order.end(), at_.begin());
  }
  for (int p = 0; p < static_cast<int>(count); ++p) rank_[at_[p]] = p;
  for (std::ptrdiff_t begin = 0; begin < count; begin += kWindow) {
    std::stable_sort(at_.begin() + begin, at_.begin() + std::min(begin + kWindow, count),
                     [&](int a, int b) { return lengths[a] < lengths[b]; });
  }
  for (int p = 0; p < static_cast<int>(count); ++p) position_[at_[p]] = p;
}

SliceOrder SliceOrder::sideBySide(const std::vector<const SliceOrder*>& parts) {
  SliceOrder all;
  for (const SliceOrder* part : parts) {
    const int first = all.count();
    all.at_.resize((all.at_.size() + kWindow - 1) / kWindow * kWindow, -1);
    const auto begin = static_cast<int>(all.at_.size());
    for (const int i : part->at_) all.at_.push_back(i < 0 ? -1 : first + i);
    for (const int position : part->position_) all.position_.push_back(begin + position);
    for (const int rank : part->rank_) all.rank_.push_back(begin + rank);
  }
  return all;
}

SlicedRows::SlicedRows(const std::vector<std::vector<Entry>>& rows, std::array<int, 2> count,
                       const SliceOrder& order)
    : count_(count), start_{0} {
  const std::vector<Entry> none;
  for (int s = 0; s < order.numSlices(); ++s) {
    const std::vector<Entry>* of[kSlice];
    const std::vector<Entry>* longest = &none;
    for (int lane = 0; lane < kSlice; ++lane) {
      const int row = order.at(kSlice * s + lane);
      of[lane] = row < 0 ? &none : &rows[row];
      if (of[lane]->size() > longest->size()) longest = of[lane];
    }
    for (std::size_t k = 0; k < longest->size(); ++k) {
      const Entry filler{(*longest)[k].source, -1};  // a source that the slice reads anyway
      for (const std::vector<Entry>* row : of) {
        const Entry& entry = k < row->size() ? (*row)[k] : filler;
        source_.push_back(entry.source);
        from_[0].push_back(entry.from);
        if (count_[1] > 0) from_[1].push_back(entry.from_next);
      }
    }
    start_.push_back(start_.back() + static_cast<int>(longest->size()));
  }
  values_.assign(static_cast<std::size_t>(count_[0] + count_[1]) * source_.size(), 0.0F);
}

std::vector<int> SlicedRows::places(std::size_t count, int stride) const {
  std::vector<int> places(count, -1);
  for (std::size_t k = 0; k < from_[0].size(); ++k) {
    if (from_[0][k] < 0) continue;
    const std::size_t entry = k / kSlice * (count_[0] + count_[1]);
    places[from_[0][k] / stride] = static_cast<int>(kSlice * entry + k % kSlice);
  }
  return places;
}

}  // namespace palpate::solver
