// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::fem {

/// Symmetric sparse matrix of 3 x 3 blocks, one block row and column per node. Both triangles are
/// stored in block compressed rows, columns ascending. The pattern is constant after construction,
/// so its symbolic analysis stays valid.
class BlockMatrix {
 public:
  BlockMatrix() = default;
  /// Pattern: the diagonal and, for each pair (i, j), the blocks (i, j) and (j, i). Values zero.
  BlockMatrix(int num_nodes, const std::vector<std::pair<int, int>>& pairs);
  /// Block-diagonal matrix with the patterns of `parts`, in their order. Values zero.
  static BlockMatrix sideBySide(const std::vector<const BlockMatrix*>& parts);

  int numNodes() const { return static_cast<int>(row_start_.size()) - 1; }
  int numBlocks() const { return static_cast<int>(column_.size()); }
  int rowBegin(int i) const { return row_start_[i]; }
  int rowEnd(int i) const { return row_start_[i + 1]; }
  int column(int slot) const { return column_[slot]; }
  /// Column of each slot.
  const int* columns() const { return column_.data(); }
  /// Slot of the diagonal block of row i.
  int diagonal(int i) const { return diagonal_[i]; }
  /// Slot of block (j, i), of block (i, j) in `slot`.
  int transposed(int slot) const { return transposed_[slot]; }
  /// Slot of block (i, j), or -1.
  int find(int i, int j) const;

  Eigen::Map<Mat3> block(int slot) { return Eigen::Map<Mat3>(values_.data() + 9 * slot); }
  Eigen::Map<const Mat3> block(int slot) const {
    return Eigen::Map<const Mat3>(values_.data() + 9 * slot);
  }
  /// 9 values per block, in slot order.
  double* values() { return values_.data(); }
  const double* values() const { return values_.data(); }
  /// Adds M to block (i, j), whose slot is `slot`. Slots off the diagonal are recorded in added().
  void addTo(int slot, int i, int j, const Mat3& M) {
    block(slot) += M;
    if (i != j) added_.push_back(slot);
  }
  /// Slots off the diagonal that addTo() wrote since forgetAdded(), with repetitions.
  const std::vector<int>& added() const { return added_; }
  void forgetAdded() { added_.clear(); }

  /// Sets all values to zero and clears added().
  void setZero();
  /// Multiplies all values by `s`.
  void scale(double s);

  /// Computes y = A x, both 3 x n.
  void multiply(const Points& x, Points* y) const;

  /// Replaces rows and columns of components with free(c, i) == 0 by those of s I, s the mean
  /// diagonal. A solve with zero right-hand side there returns zero there.
  void constrain(const Eigen::Matrix3Xd& free);

 private:
  std::vector<int> row_start_{0}, column_, diagonal_, transposed_;
  std::vector<double> values_;  // 9 a block, column-major
  std::vector<int> added_;
};

}  // namespace palpate::fem
