// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "aligned_vector.h"
#include "kernels/pcg_arrays.h"

namespace palpate::solver {

/// Where things that are numbered lie in slices: those of about one length side by side.
class SliceOrder {
 public:
  SliceOrder() = default;
  /// In the given `order`, or by number if that is empty, sorted by `lengths` within windows, so
  /// that neighbours stay near each other.
  explicit SliceOrder(const std::vector<int>& lengths, const std::vector<int>& order = {});

  /// Several orders, one behind the other; each begins with a window of its own. Numbers of a part
  /// follow those of the parts before.
  static SliceOrder sideBySide(const std::vector<const SliceOrder*>& parts);

  int count() const { return static_cast<int>(position_.size()); }
  int numSlices() const { return static_cast<int>(at_.size()) / kSlice; }
  /// What is at a position: slice kSlice + lane; -1 beyond the last, also of a part.
  int at(int position) const { return at_[position]; }
  int position(int i) const { return position_[i]; }
  /// Where i is in the order, before it was sorted within its window.
  int rank(int i) const { return rank_[i]; }
  /// Where the first component of i begins in a vector of `components`.
  std::ptrdiff_t offset(int i, int components) const {
    const int slice = position_[i] / kSlice;
    return static_cast<std::ptrdiff_t>(components) * kSlice * slice + position_[i] % kSlice;
  }

 private:
  std::vector<int> at_, position_, rank_;
};

/// Rows of a sparse matrix in single precision, as PcgRows has them. The values of an entry come
/// from one array or from two.
class SlicedRows {
 public:
  struct Entry {
    int source;          ///< Where that begins which it is multiplied with.
    int from;            ///< Where its values begin.
    int from_next = -1;  ///< Where those of the second part begin, if it has any.
  };

  SlicedRows() = default;
  /// `rows`: the entries of each; `count`: values of an entry in each part.
  SlicedRows(const std::vector<std::vector<Entry>>& rows, std::array<int, 2> count,
             const SliceOrder& order);

  /// Takes the values of a part of slices from `begin` to `end`.
  void assign(int part, int begin, int end, const double* values, const PcgKernels& kernels) {
    const PcgPart taken{part == 0 ? 0 : count_[0], count_[part], count_[0] + count_[1],
                        from_[part].data()};
    kernels.pack(start_.data(), taken, begin, end, values, values_.data());
  }
  /// Where the first part of each entry is, by where its values come from over `stride`.
  std::vector<int> places(std::size_t count, int stride) const;
  /// Takes the values of the first part of the entry at one of these places.
  void assignAt(int place, const double* values) {
    for (int c = 0; c < count_[0]; ++c) values_[place + kSlice * c] = static_cast<float>(values[c]);
  }
  /// Of values and where they are multiplied.
  std::size_t bytes() const {
    return sizeof(float) * values_.size() + sizeof(int) * source_.size();
  }
  PcgRows rows() const { return {start_.data(), source_.data(), values_.data()}; }

 private:
  std::array<int, 2> count_{};
  std::vector<int> start_;
  AlignedVector<int> source_;
  std::array<std::vector<int>, 2> from_;  // -1 for what fills up
  AlignedVector<float> values_;
};

}  // namespace palpate::solver
