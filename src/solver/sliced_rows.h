// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/pcg_arrays.h"

namespace palpate::solver {

/// Where things that are numbered lie in slices: those of about one length side by side.
class SliceOrder {
 public:
  SliceOrder() = default;
  /// Sorted by `lengths` within windows, so that neighbours stay near each other.
  explicit SliceOrder(const std::vector<int>& lengths);

  int count() const { return static_cast<int>(position_.size()); }
  int numSlices() const { return static_cast<int>(at_.size()) / kSlice; }
  /// What is at a position: slice kSlice + lane; -1 beyond the last.
  int at(int position) const { return at_[position]; }
  int position(int i) const { return position_[i]; }
  /// Where the first component of i begins in a vector of `components`.
  std::ptrdiff_t offset(int i, int components) const {
    const int slice = position_[i] / kSlice;
    return static_cast<std::ptrdiff_t>(components) * kSlice * slice + position_[i] % kSlice;
  }

 private:
  std::vector<int> at_, position_;
};

/// Rows of a sparse matrix in single precision, as PcgRows has them.
class SlicedRows {
 public:
  struct Entry {
    int source;  ///< Where that begins which it is multiplied with.
    int from;    ///< Where its values begin.
  };

  SlicedRows() = default;
  /// `rows`: the entries of each; `size`: values of an entry.
  SlicedRows(const std::vector<std::vector<Entry>>& rows, int size, const SliceOrder& order);

  /// Takes the values of slices from `begin` to `end` from `values`.
  void assign(int begin, int end, const double* values, const PcgKernels& kernels) {
    kernels.pack(start_.data(), from_.data(), size_, begin, end, values, values_.data());
  }
  PcgRows rows() const { return {start_.data(), source_.data(), values_.data()}; }

 private:
  int size_ = 0;
  std::vector<int> start_, source_, from_;  // from_: -1 for what fills up
  std::vector<float> values_;
};

}  // namespace palpate::solver
