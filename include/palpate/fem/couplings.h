// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::fem {

/// Part of a symmetric matrix outside the pattern of a BlockMatrix: 3 x 3 blocks between nodes that
/// no element connects, such as those of a touch. The pattern may change from matrix to matrix.
class Couplings {
 public:
  struct Block {
    int i, j;  ///< Row and column, different.
    Mat3 values;
  };

  bool empty() const { return blocks_.empty(); }
  /// Blocks in the order of add(); equal pairs are summed, and transposes are implied.
  const std::vector<Block>& blocks() const { return blocks_; }
  /// Pairs i < j, ascending, without repetition.
  std::vector<std::pair<int, int>> pairs() const;

  void add(int i, int j, const Mat3& values) { blocks_.push_back({i, j, values}); }
  void clear() { blocks_.clear(); }

  /// Computes y += A x, both 3 x n.
  void addProduct(const Points& x, Points* y) const;
  /// Multiplies all blocks by s.
  void scale(double s);
  /// Sets rows and columns of components with free(c, i) == 0 to zero.
  void constrain(const Eigen::Matrix3Xd& free);

 private:
  std::vector<Block> blocks_;
};

}  // namespace palpate::fem
