// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/couplings.h"

#include <algorithm>

namespace palpate::fem {

std::vector<std::pair<int, int>> Couplings::pairs() const {
  std::vector<std::pair<int, int>> pairs;
  for (const Block& block : blocks_) {
    if (block.i < block.j) pairs.emplace_back(block.i, block.j);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

void Couplings::addProduct(const Points& x, Points* y) const {
  for (const Block& block : blocks_) y->col(block.i) += block.values * x.col(block.j);
}

void Couplings::scale(double s) {
  for (Block& block : blocks_) block.values *= s;
}

void Couplings::constrain(const Eigen::Matrix3Xd& free) {
  for (Block& block : blocks_) {
    block.values = (free.col(block.i) * free.col(block.j).transpose()).cwiseProduct(block.values);
  }
}

}  // namespace palpate::fem
