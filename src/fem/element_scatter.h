// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/for_all.h"
#include "palpate/base/types.h"
#include "palpate/fem/block_matrix.h"
#include "sources.h"

namespace palpate::fem {

/// Sums results of elements with N nodes into nodes and matrix blocks. Each node and block sums in
/// ascending order of elements, so results are bitwise independent of threads.
template <int N>
class ElementScatter {
 public:
  static constexpr int kBlocks = N * (N + 1) / 2;  ///< Upper triangle of blocks, row after row.
  using Vectors = Eigen::Matrix<double, 3 * N, Eigen::Dynamic>;
  using Blocks = Eigen::Matrix<double, 9 * kBlocks, Eigen::Dynamic>;

  ElementScatter(const Eigen::Matrix<int, N, Eigen::Dynamic>& elements, int num_nodes);

  const BlockMatrix& pattern() const { return pattern_; }

  /// Lists the sources of each node and block. Must precede the functions below.
  void prepare(const Eigen::Matrix<int, N, Eigen::Dynamic>& elements);

  /// g.col(i) = sum of the element vectors at node i. `local`: a column per element.
  void gatherNodes(const Vectors& local, ThreadPool* pool, Points* g) const;
  /// K = sum of the element matrices.
  void gatherBlocks(const Blocks& local, ThreadPool* pool, BlockMatrix* K) const;

 private:
  struct BlockSource {
    int index;        // of the block in `local`
    bool transposed;  // the element holds the block's transpose
  };
  Sources<int> node_sources_;           // vectors in `local` of each node
  Sources<BlockSource> block_sources_;  // blocks in `local` of each block of the upper triangle
  std::vector<int> upper_slot_, lower_slot_;
  BlockMatrix pattern_;
};

}  // namespace palpate::fem
