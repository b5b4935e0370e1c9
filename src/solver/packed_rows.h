// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "kernels/pcg_arrays.h"

namespace palpate::solver {

constexpr int kChunk = 256;  ///< Rows that one thread works through in one go.

/// Rows of a sparse matrix in single precision, in the order that PcgRows asks for.
class PackedRows {
 public:
  struct Entry {
    int source;  ///< What it is multiplied with.
    int from;    ///< Where its values come from, in units of entries.
  };

  PackedRows() = default;
  /// `rows`: the entries of each; `size`: values of an entry; sources are stored times `stride`.
  /// The order of rows is that of their lengths in `like`, which has as many.
  PackedRows(const std::vector<std::vector<Entry>>& rows, int size, unsigned stride,
             const std::vector<std::vector<Entry>>& like);

  int numChunks() const { return (static_cast<int>(target_.size()) + kChunk - 1) / kChunk; }
  /// Takes the values of the rows of one chunk from `values`.
  void assign(int chunk, const double* values, const PcgKernels& kernels);
  PcgRows rows() const { return {target_.data(), start_.data(), source_.data(), values_.data()}; }

 private:
  int size_ = 0;
  std::vector<int> target_, start_, from_;  // from_: -1 for what fills up
  std::vector<unsigned> source_;
  std::vector<float> values_;
};

}  // namespace palpate::solver
