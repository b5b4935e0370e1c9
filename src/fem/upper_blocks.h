// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "kernels/tet_batch.h"
#include "palpate/base/thread_pool.h"
#include "palpate/fem/block_matrix.h"

namespace palpate::fem {

/// The blocks above the diagonal of a block matrix, close together in memory while elements are
/// added to them. For matrices that no shift of all nodes sees: their diagonal follows.
class UpperBlocks {
 public:
  explicit UpperBlocks(const BlockMatrix& pattern);

  /// Where the 9 values of block (i, j), i < j, begin.
  int offset(const BlockMatrix& pattern, int i, int j) const {
    return 9 * index_[static_cast<std::size_t>(pattern.find(i, j))];
  }
  double* clear();
  /// K = the blocks, their transposed ones below, and minus the sums of rows on the diagonal.
  void expand(ExpandRow expand_row, ThreadPool* pool, BlockMatrix* K) const;

 private:
  std::vector<int> index_;  // of each slot off the diagonal: its block, or that of its transposed
  std::vector<double> values_;
};

}  // namespace palpate::fem
