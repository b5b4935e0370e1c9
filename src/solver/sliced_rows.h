// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "aligned_vector.h"
#include "kernels/pcg_arrays.h"

namespace palpate::solver {

/// Order of numbered items in slices, with items of similar length in the same slice.
class SliceOrder {
 public:
  SliceOrder() = default;
  /// Sorts by `lengths` within windows of `order` (empty: by number), so that neighbours stay
  /// close.
  explicit SliceOrder(const std::vector<int>& lengths, const std::vector<int>& order = {});

  /// Concatenates orders, each beginning with a new window. Numbers continue from part to part.
  static SliceOrder sideBySide(const std::vector<const SliceOrder*>& parts);

  int count() const { return static_cast<int>(position_.size()); }
  int numSlices() const { return static_cast<int>(at_.size()) / kSlice; }
  /// Item at a position, slice kSlice + lane; -1 for padding.
  int at(int position) const { return at_[position]; }
  int position(int i) const { return position_[i]; }
  /// Rank of i in the order before the sort within windows.
  int rank(int i) const { return rank_[i]; }
  /// Offset of the first component of i in a vector of `components`.
  std::ptrdiff_t offset(int i, int components) const {
    const int slice = position_[i] / kSlice;
    return static_cast<std::ptrdiff_t>(components) * kSlice * slice + position_[i] % kSlice;
  }

 private:
  std::vector<int> at_, position_, rank_;
};

/// Rows of a sparse matrix in single precision, in the layout of PcgRows. Values of an entry come
/// from one or two arrays.
class SlicedRows {
 public:
  struct Entry {
    int source;          ///< Offset of the vector's factor.
    int from;            ///< Offset of its values.
    int from_next = -1;  ///< Offset of the second part's values, if any.
  };

  SlicedRows() = default;
  /// `rows`: entries of each row; `count`: values per entry of each part.
  SlicedRows(const std::vector<std::vector<Entry>>& rows, std::array<int, 2> count,
             const SliceOrder& order);

  /// Packs the values of a part for slices [begin, end).
  void assign(int part, int begin, int end, const double* values, const PcgKernels& kernels) {
    const PcgPart taken{part == 0 ? 0 : count_[0], count_[part], count_[0] + count_[1],
                        from_[part].data()};
    kernels.pack(start_.data(), taken, begin, end, values, values_.data());
  }
  /// Position of each entry's first part, indexed by the offset of its values over `stride`.
  std::vector<int> places(std::size_t count, int stride) const;
  /// Packs the values of the first part of the entry at such a position.
  void assignAt(int place, const double* values) {
    for (int c = 0; c < count_[0]; ++c) values_[place + kSlice * c] = static_cast<float>(values[c]);
  }
  /// Size of the values and sources.
  std::size_t bytes() const {
    return sizeof(float) * values_.size() + sizeof(int) * source_.size();
  }
  PcgRows rows() const { return {start_.data(), source_.data(), values_.data()}; }

 private:
  std::array<int, 2> count_{};
  std::vector<int> start_;
  AlignedVector<int> source_;
  std::array<std::vector<int>, 2> from_;  // -1 for padding
  AlignedVector<float> values_;
};

}  // namespace palpate::solver
