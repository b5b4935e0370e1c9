// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/block_matrix.h"

#include <algorithm>

namespace palpate::fem {

BlockMatrix::BlockMatrix(int num_nodes, const std::vector<std::pair<int, int>>& pairs) {
  // Collects the columns of each row, unsorted and with repetitions: count first, then fill.
  std::vector<int> start(static_cast<std::size_t>(num_nodes) + 1, 0);
  for (int i = 0; i < num_nodes; ++i) start[i + 1] = 1;
  for (const auto& [i, j] : pairs) {
    ++start[i + 1];
    ++start[j + 1];
  }
  for (int i = 0; i < num_nodes; ++i) start[i + 1] += start[i];
  std::vector<int> columns(static_cast<std::size_t>(start.back())), next(start);
  for (int i = 0; i < num_nodes; ++i) columns[next[i]++] = i;
  for (const auto& [i, j] : pairs) {
    columns[next[i]++] = j;
    columns[next[j]++] = i;
  }

  row_start_.assign(num_nodes + 1, 0);
  diagonal_.resize(num_nodes);
  // Removes repetitions before sorting: rows are short and mostly repetitions.
  std::vector<int> seen_in(static_cast<std::size_t>(num_nodes), -1);
  for (int i = 0; i < num_nodes; ++i) {
    for (int k = start[i]; k < start[i + 1]; ++k) {
      if (seen_in[columns[k]] == i) continue;
      seen_in[columns[k]] = i;
      column_.push_back(columns[k]);
    }
    std::sort(column_.begin() + row_start_[i], column_.end());
    row_start_[i + 1] = static_cast<int>(column_.size());
    diagonal_[i] = find(i, i);
  }
  values_.assign(9 * column_.size(), 0.0);
  // Rows are visited in order, so blocks (i, j) with ascending i fill row j in column order.
  transposed_.resize(column_.size());
  next.assign(row_start_.begin(), row_start_.end() - 1);
  for (std::size_t slot = 0; slot < column_.size(); ++slot) {
    transposed_[slot] = next[column_[slot]]++;
  }
}

BlockMatrix BlockMatrix::sideBySide(const std::vector<const BlockMatrix*>& parts) {
  BlockMatrix all;
  for (const BlockMatrix* part : parts) {
    const int first_node = all.numNodes(), first_slot = all.numBlocks();
    const auto append = [](const std::vector<int>& from, std::size_t skipped, int shift,
                           std::vector<int>* to) {
      for (std::size_t k = skipped; k < from.size(); ++k) to->push_back(from[k] + shift);
    };
    append(part->row_start_, 1, first_slot, &all.row_start_);
    append(part->column_, 0, first_node, &all.column_);
    append(part->diagonal_, 0, first_slot, &all.diagonal_);
    append(part->transposed_, 0, first_slot, &all.transposed_);
  }
  all.values_.assign(9 * all.column_.size(), 0.0);
  return all;
}

// Branch-free binary search.
int BlockMatrix::find(int i, int j) const {
  const int* first = column_.data() + row_start_[i];
  for (int count = row_start_[i + 1] - row_start_[i]; count > 1;) {
    const int half = count / 2;
    first += first[half] <= j ? half : 0;
    count -= half;
  }
  return *first == j ? static_cast<int>(first - column_.data()) : -1;
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
