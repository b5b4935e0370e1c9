// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/block_matrix.h"

#include <algorithm>

namespace palpate::fem {

BlockMatrix::BlockMatrix(int num_nodes, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<std::pair<int, int>> entries;
  entries.reserve(2 * pairs.size() + num_nodes);
  for (int i = 0; i < num_nodes; ++i) entries.emplace_back(i, i);
  for (const auto& [i, j] : pairs) {
    entries.emplace_back(i, j);
    entries.emplace_back(j, i);
  }
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());

  row_start_.assign(num_nodes + 1, 0);
  diagonal_.resize(num_nodes);
  column_.reserve(entries.size());
  for (const auto& [i, j] : entries) {
    if (i == j) diagonal_[i] = static_cast<int>(column_.size());
    column_.push_back(j);
    row_start_[i + 1] = static_cast<int>(column_.size());
  }
  values_.assign(9 * column_.size(), 0.0);
  // Row after row, the blocks (i, j) with i ascending are met in the order of row j's columns.
  transposed_.resize(column_.size());
  std::vector<int> next(row_start_.begin(), row_start_.end() - 1);
  for (std::size_t slot = 0; slot < column_.size(); ++slot) {
    transposed_[slot] = next[column_[slot]]++;
  }
}

int BlockMatrix::find(int i, int j) const {
  const auto begin = column_.begin() + row_start_[i], end = column_.begin() + row_start_[i + 1];
  const auto it = std::lower_bound(begin, end, j);
  return it != end && *it == j ? static_cast<int>(it - column_.begin()) : -1;
}

void BlockMatrix::setZero() {
  std::fill(values_.begin(), values_.end(), 0.0);
  added_.clear();
}

void BlockMatrix::scale(double s) {
  for (double& value : values_) value *= s;
}

void BlockMatrix::multiply(const Points& x, Points* y) const {
  y->resize(3, numNodes());
  const double* a = values_.data();
  for (int i = 0; i < numNodes(); ++i) {
    double y0 = 0.0, y1 = 0.0, y2 = 0.0;
    for (int slot = row_start_[i]; slot < row_start_[i + 1]; ++slot, a += 9) {
      const double* xj = x.data() + 3 * column_[slot];
      y0 += a[0] * xj[0] + a[3] * xj[1] + a[6] * xj[2];
      y1 += a[1] * xj[0] + a[4] * xj[1] + a[7] * xj[2];
      y2 += a[2] * xj[0] + a[5] * xj[1] + a[8] * xj[2];
    }
    y->col(i) << y0, y1, y2;
  }
}

void BlockMatrix::constrain(const Eigen::Matrix3Xd& free) {
  double scale = 0.0;
  for (int i = 0; i < numNodes(); ++i) scale += block(diagonal_[i]).trace();
  scale = std::max(scale / (3.0 * numNodes()), 1e-300);
  for (int i = 0; i < numNodes(); ++i) {
    const Vec3 mask = free.col(i);
    if (mask[0] * mask[1] * mask[2] == 1.0) continue;
    for (int slot = row_start_[i]; slot < row_start_[i + 1]; ++slot) {
      block(slot) = mask.asDiagonal() * block(slot);
      block(transposed_[slot]) = block(transposed_[slot]) * mask.asDiagonal();
    }
    block(diagonal_[i]).diagonal() += scale * (Vec3::Ones() - mask);
  }
}

}  // namespace palpate::fem
