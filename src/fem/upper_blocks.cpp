// SPDX-License-Identifier: GPL-3.0-or-later
#include "upper_blocks.h"

#include <algorithm>

#include "palpate/base/for_all.h"

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

void UpperBlocks::expand(ExpandRow expand_row, ThreadPool* pool, BlockMatrix* K) const {
  forAll(pool, static_cast<std::size_t>(K->numNodes()), [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<int>(begin); i < static_cast<int>(end); ++i) {
      const int first = K->rowBegin(i), diagonal = K->diagonal(i);
      expand_row(index_.data() + first, diagonal - first, K->rowEnd(i) - diagonal - 1,
                 values_.data(), K->values() + 9 * static_cast<std::ptrdiff_t>(first));
    }
  });
}

}  // namespace palpate::fem
