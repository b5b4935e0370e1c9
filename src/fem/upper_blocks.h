// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "kernels/tet_batch.h"
#include "palpate/base/thread_pool.h"
#include "palpate/fem/block_matrix.h"

namespace palpate::fem {

/// Blocks above the diagonal of a block matrix, contiguous for assembly. For translation-invariant
/// matrices, whose diagonal follows from the other blocks.
class UpperBlocks {
 public:
  explicit UpperBlocks(const BlockMatrix& pattern);

  /// Offset of the 9 values of block (i, j), i < j.
  int offset(const BlockMatrix& pattern, int i, int j) const {
    return 9 * index_[static_cast<std::size_t>(pattern.find(i, j))];
  }
  double* clear();
  /// K = the blocks, their transposes below the diagonal, and minus the row sums on the diagonal.
  void expand(ExpandRow expand_row, ThreadPool* pool, BlockMatrix* K) const;

 private:
  std::vector<int> index_;  // block of each slot off the diagonal, or of its transpose
  std::vector<double> values_;
};

}  // namespace palpate::fem
