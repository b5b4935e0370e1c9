// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/base/types.h"
#include "palpate/fem/block_matrix.h"

namespace palpate::fem {

/// Sums what four-node elements computed into nodes and matrix blocks: each node and each block
/// gathers its contributions in ascending order of elements, so that threads never change a bit.
class ElementScatter {
 public:
  static constexpr int kBlocks = 10;  ///< Upper triangle of 4 x 4 blocks, row after row.

  ElementScatter(const Eigen::Matrix4Xi& elements, int num_nodes);

  const BlockMatrix& pattern() const { return pattern_; }

  /// g.col(i) = sum of the element vectors at node i. `local`: 12 x m, node after node.
  void gatherNodes(const Eigen::Matrix<double, 12, Eigen::Dynamic>& local, ThreadPool* pool,
                   Points* g) const;
  /// K = sum of the element matrices. `local`: 90 x m, kBlocks blocks of 9.
  void gatherBlocks(const Eigen::Matrix<double, 90, Eigen::Dynamic>& local, ThreadPool* pool,
                    BlockMatrix* K) const;

 private:
  struct Source {
    int index;        // of the 9 numbers (or 3) in `local`, in units of such
    bool transposed;  // the element holds the block's transpose
  };
  std::vector<int> node_start_, block_start_;
  std::vector<Source> node_source_, block_source_;  // blocks: upper triangle slots only
  std::vector<int> upper_slot_, lower_slot_;
  BlockMatrix pattern_;
};

/// body(begin, end) on all of [0, count), on the pool if there is one.
template <class Body>
void forAll(ThreadPool* pool, std::size_t count, const Body& body) {
  if (pool) {
    pool->forRanges(count, body);
  } else {
    body(std::size_t{0}, count);
  }
}

}  // namespace palpate::fem
