// SPDX-License-Identifier: GPL-3.0-or-later
#include "gathered_blocks.h"

namespace palpate::solver {
namespace {

/// Calls visit(i, j) for each two nodes i <= j of each volume, in order.
template <class Visit>
void forPairs(const fem::VolumeStiffness::Pattern& pattern, const Visit& visit) {
  for (std::size_t p = 0; p + 1 < pattern.start.size(); ++p) {
    for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
      for (int l = k; l < pattern.start[p + 1]; ++l) visit(pattern.node[k], pattern.node[l]);
    }
  }
}

void appendPairs(const fem::BlockMatrix& blocks, std::vector<std::pair<int, int>>* pairs) {
  for (int i = 0; i < blocks.numNodes(); ++i) {
    for (int slot = blocks.diagonal(i) + 1; slot < blocks.rowEnd(i); ++slot) {
      pairs->emplace_back(i, blocks.column(slot));
    }
  }
}

}  // namespace

GatheredBlocks::GatheredBlocks(const fem::Stiffness& A, bool with_volumes)
    : with_volumes_(with_volumes), wide_(with_volumes || !A.couplings().empty()) {
  coupled_ = A.couplings().pairs();
  if (!wide_) return;
  std::vector<std::pair<int, int>> pairs = coupled_;
  appendPairs(A.blocks(), &pairs);
  if (with_volumes_) {
    forPairs(*A.volume().pattern, [&](int i, int j) {
      if (i != j) pairs.emplace_back(i, j);
    });
  }
  own_ = fem::BlockMatrix(A.numNodes(), pairs);
  if (with_volumes_) {
    forPairs(*A.volume().pattern, [&](int i, int j) { slot_.push_back(own_.find(i, j)); });
  }
}

GatheredBlocks::GatheredBlocks(const GatheredBlocks& uncoupled, const fem::Stiffness& A)
    : with_volumes_(uncoupled.with_volumes_), wide_(true), coupled_(A.couplings().pairs()) {
  const fem::BlockMatrix& before = uncoupled.pattern(A);
  std::vector<std::pair<int, int>> pairs = coupled_;
  appendPairs(before, &pairs);
  own_ = fem::BlockMatrix(A.numNodes(), pairs);
  if (!with_volumes_) return;
  std::vector<int> slot_of(static_cast<std::size_t>(before.numBlocks()));  // in own_, of before's
  for (int i = 0; i < before.numNodes(); ++i) {
    for (int slot = before.rowBegin(i), own_slot = own_.rowBegin(i); slot < before.rowEnd(i);
         ++slot) {
      while (own_.column(own_slot) != before.column(slot)) ++own_slot;
      slot_of[slot] = own_slot;
    }
  }
  slot_.reserve(uncoupled.slot_.size());
  for (int slot : uncoupled.slot_) slot_.push_back(slot_of[slot]);
}

const fem::BlockMatrix& GatheredBlocks::gather(const fem::Stiffness& A) {
  if (!wide_) return A.blocks();
  own_.setZero();
  const fem::BlockMatrix& blocks = A.blocks();
  for (int i = 0; i < blocks.numNodes(); ++i) {
    int own_slot = own_.diagonal(i);
    for (int slot = blocks.diagonal(i); slot < blocks.rowEnd(i); ++slot) {
      while (own_.column(own_slot) != blocks.column(slot)) ++own_slot;
      own_.block(own_slot) = blocks.block(slot);
    }
  }
  for (const fem::Couplings::Block& block : A.couplings().blocks()) {
    if (block.i < block.j) own_.block(own_.find(block.i, block.j)) += block.values;
  }
  if (with_volumes_) addVolumes(A.volume());
  return own_;
}

void GatheredBlocks::addVolumes(const fem::VolumeStiffness& volume) {
  const std::vector<int>& start = volume.pattern->start;
  auto slot = slot_.begin();
  for (Eigen::Index p = 0; p < volume.numRows(); ++p) {
    const double weight = volume.factor * volume.metric->weights()[p];
    for (int k = start[p]; k < start[p + 1]; ++k) {
      const Vec3 b = weight * volume.rows.col(k);
      for (int l = k; l < start[p + 1]; ++l) {
        own_.block(*slot++) += b * volume.rows.col(l).transpose();
      }
    }
  }
}

}  // namespace palpate::solver
