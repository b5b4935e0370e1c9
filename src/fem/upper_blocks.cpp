// SPDX-License-Identifier: GPL-3.0-or-later
#include "upper_blocks.h"

#include <algorithm>

#include "for_all.h"

namespace palpate::fem {

UpperBlocks::UpperBlocks(const BlockMatrix& pattern) : index_(pattern.numBlocks(), -1) {
  int count = 0;
  for (int i = 0; i < pattern.numNodes(); ++i) {
    for (int slot = pattern.diagonal(i) + 1; slot < pattern.rowEnd(i); ++slot) {
      index_[slot] = index_[pattern.transposed(slot)] = count++;
    }
  }
  values_.resize(9 * static_cast<std::size_t>(count));
}

double* UpperBlocks::clear() {
  std::fill(values_.begin(), values_.end(), 0.0);
  return values_.data();
}

void UpperBlocks::expand(ThreadPool* pool, BlockMatrix* K) const {
  forAll(pool, static_cast<std::size_t>(K->numNodes()), [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<int>(begin); i < static_cast<int>(end); ++i) {
      double sum[9] = {};
      const int diagonal = K->diagonal(i);
      for (int slot = K->rowBegin(i); slot < K->rowEnd(i); ++slot) {
        if (slot == diagonal) continue;
        const double* from = values_.data() + 9 * static_cast<std::ptrdiff_t>(index_[slot]);
        double* to = K->values() + 9 * static_cast<std::ptrdiff_t>(slot);
        if (slot < diagonal) {
          for (int c = 0; c < 9; ++c) to[c] = from[3 * (c % 3) + c / 3];
        } else {
          for (int c = 0; c < 9; ++c) to[c] = from[c];
        }
        for (int c = 0; c < 9; ++c) sum[c] += to[c];
      }
      double* to = K->values() + 9 * static_cast<std::ptrdiff_t>(diagonal);
      for (int c = 0; c < 9; ++c) to[c] = -0.5 * (sum[c] + sum[3 * (c % 3) + c / 3]);
    }
  });
}

}  // namespace palpate::fem
