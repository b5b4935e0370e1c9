// SPDX-License-Identifier: GPL-3.0-or-later
#include "pcg_matrix.h"

#include <algorithm>

#include "palpate/mesh/hilbert_order.h"

namespace palpate::solver {

PcgMatrix::PcgMatrix(ThreadPool* pool, Isa isa, const std::vector<PcgMatrix*>& bodies)
    : PcgMatrix(pool, isa, Points()) {
  bodies_ = bodies;
}

void PcgMatrix::orderNodes(const fem::BlockMatrix& K) {
  if (bodies_.empty()) {
    std::vector<int> lengths(static_cast<std::size_t>(K.numNodes()));
    for (int i = 0; i < K.numNodes(); ++i) lengths[i] = K.rowEnd(i) - K.rowBegin(i);
    nodes_ = SliceOrder(lengths, mesh::hilbertOrder(points_));
    parts_ = {{nullptr, 0, 0, nodes_.numSlices()}};
    return;
  }
  std::vector<const SliceOrder*> orders;
  orders.reserve(bodies_.size());
  for (const PcgMatrix* body : bodies_) orders.push_back(&body->nodes_);
  nodes_ = SliceOrder::sideBySide(orders);
  int first_node = 0;
  parts_.clear();
  for (const PcgMatrix* body : bodies_) {
    const int first_slice = nodes_.position(first_node + body->nodes_.at(0)) / kSlice;
    parts_.push_back({body->coarse_.get(), first_node, first_slice, body->nodes_.numSlices()});
    first_node += body->nodes_.count();
  }
}

void PcgMatrix::takePattern(const fem::Stiffness& A) {
  const fem::BlockMatrix& K = A.blocks();
  orderNodes(K);
  if (A.hasVolume()) takeVolumes(K, *A.volume().pattern);
  takeRows(A);
  const std::size_t lanes = static_cast<std::size_t>(kSlice) * nodes_.numSlices();
  inverse_diagonal_.resize(6 * lanes);
  for (int p = 0; p < static_cast<int>(lanes); ++p) {
    diagonal_.push_back(9 * K.diagonal(std::max(nodes_.at(p), 0)));  // padding lanes: any block
  }
  partial_.resize(static_cast<std::size_t>(Chunks::number(nodes_.numSlices())));
  partial_2_ = partial_;
}

void PcgMatrix::addCoarse(const fem::Stiffness& A) {
  if (nodes_.count() == 0) takePattern(A);
  coarse_ = std::make_unique<CoarseSpace>(A, points_, nodes_, kernels_, pool_);
  parts_.front().coarse = coarse_.get();
}

// Packs rows of K with those of B of their home pressures.
void PcgMatrix::takeRows(const fem::Stiffness& A) {
  const fem::BlockMatrix& K = A.blocks();
  std::vector<std::vector<SlicedRows::Entry>> rows(static_cast<std::size_t>(K.numNodes()));
  for (int i = 0; i < K.numNodes(); ++i) {
    for (int slot = K.rowBegin(i); slot < K.rowEnd(i); ++slot) {
      rows[i].push_back({kNodeStride * nodes_.position(K.column(slot)), 9 * slot});
    }
    const int p = A.hasVolume() ? pressures_.atHome(i) : -1;
    if (p < 0) continue;
    const fem::VolumeStiffness::Pattern& pattern = *A.volume().pattern;
    for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
      rows[i][K.find(i, pattern.node[k]) - K.rowBegin(i)].from_next = 3 * k;
    }
  }
  rows_ = SlicedRows(rows, {9, A.hasVolume() ? 3 : 0}, nodes_);
  place_ = rows_.places(static_cast<std::size_t>(K.numBlocks()), 9);
}

void PcgMatrix::takeVolumes(const fem::BlockMatrix& K,
                            const fem::VolumeStiffness::Pattern& pattern) {
  pressures_ = PressureLayout(K, pattern, nodes_);
  std::vector<std::vector<SlicedRows::Entry>> columns(static_cast<std::size_t>(nodes_.count()));
  for (int p = 0; p < pressures_.count(); ++p) {
    for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
      columns[pattern.node[k]].push_back({pressures_.position(p), 3 * k});
    }
  }
  takeReach(columns);
  columns_ = SlicedRows(columns, {3, 0}, nodes_);
  std::vector<std::vector<SlicedRows::Entry>> others;
  for (int p : pressures_.numbers()) {
    others.emplace_back();
    for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
      others.back().push_back({kNodeStride * nodes_.position(pattern.node[k]), 3 * k});
    }
  }
  others_ = SlicedRows(others, {3, 0}, pressures_.others());
  c_.assign(static_cast<std::size_t>(kSlice) * pressures_.numSlices(), 0.0F);
  weights_ = c_;
}

// Ranges of pressure chunks in the columns; other pressures come after all nodes.
void PcgMatrix::takeReach(const std::vector<std::vector<SlicedRows::Entry>>& columns) {
  constexpr int kNodes = kSlice * Chunks::kSlices;
  const int beyond = kSlice * nodes_.numSlices();
  reach_.assign(static_cast<std::size_t>(Chunks::number(nodes_.numSlices())), Reach{});
  added_.assign(reach_.size(), 0);
  for (int i = 0; i < nodes_.count(); ++i) {
    Reach& reach = reach_[nodes_.position(i) / kNodes];
    for (const SlicedRows::Entry& entry : columns[i]) {
      reach.first = std::min(reach.first, entry.source / kNodes);
      reach.last = std::max(reach.last, entry.source / kNodes);
      reach.others |= entry.source >= beyond;
    }
  }
}

void PcgMatrix::packVolumes(const fem::VolumeStiffness& volume) {
  const double* values = volume.rows.data();
  chunks_.forAll(nodes_.numSlices(), [&](int, int begin, int end) {
    rows_.assign(1, begin, end, values, kernels_);
    columns_.assign(0, begin, end, values, kernels_);
  });
  others_.assign(0, 0, pressures_.others().numSlices(), values, kernels_);
  factor_ = volume.factor;
  metric_ = volume.metric->isDiagonal() ? nullptr : volume.metric.get();
  for (int p = 0; p < pressures_.count(); ++p) {
    weights_[pressures_.position(p)] = static_cast<float>(factor_ * volume.metric->weights()[p]);
  }
}

PcgVolumes PcgMatrix::volumes(const float* weights) {
  return {others_.rows(), columns_.rows(), weights, c_.data()};
}

bool PcgMatrix::invertDiagonal(const fem::Stiffness& A) {
  const PcgVolumes B = volumes(weights_.data());
  chunks_.forAll(nodes_.numSlices(), [&](int chunk, int begin, int end) {
    partial_[chunk] =
        kernels_.invert(A.blocks().values(), diagonal_.data(), A.hasVolume() ? &B : nullptr, begin,
                        end, inverse_diagonal_.data());
  });
  return std::find(partial_.begin(), partial_.end(), 0.0) == partial_.end();
}

void PcgMatrix::pack(const fem::BlockMatrix& K, const std::vector<int>& changed) {
  const auto take = [&](int slot) { rows_.assignAt(place_[slot], K.block(slot).data()); };
  for (int i = 0; i < K.numNodes(); ++i) take(K.diagonal(i));
  for (int slot : changed) take(slot);
}

void PcgMatrix::takeCouplings(const fem::Couplings& couplings) {
  couplings_.clear();
  for (const fem::Couplings::Block& block : couplings.blocks()) {
    couplings_.push_back({nodes_.offset(block.i, 3), nodes_.offset(block.j, 3), block.values});
  }
}

void PcgMatrix::takeRankOnes(const fem::RankOnes& rank_ones) {
  num_rank_ones_ = rank_ones.size();
  if (rank_ones_.size() < num_rank_ones_) rank_ones_.resize(num_rank_ones_);
  for (std::size_t t = 0; t < num_rank_ones_; ++t) {
    RankOne& to = rank_ones_[t];
    to.nodes.clear();
    for (const int i : rank_ones[t].nodes) to.nodes.push_back(nodes_.offset(i, 3));
    to.a = rank_ones[t].a;
    to.c = rank_ones[t].c;
  }
}

bool PcgMatrix::assign(const fem::Stiffness& A, const std::vector<int>* changed) {
  if (nodes_.count() == 0) takePattern(A);
  takeCouplings(A.couplings());
  takeRankOnes(A.rankOnes());
  for (const Part& part : parts_) {
    if (part.coarse) part.coarse->leaveOut(A, part.first_node);
  }
  if (changed) {
    pack(A.blocks(), *changed);
    return invertDiagonal(A);
  }
  const double* values = A.blocks().values();
  chunks_.forAll(nodes_.numSlices(),
                 [&](int, int begin, int end) { rows_.assign(0, begin, end, values, kernels_); });
  if (A.hasVolume()) packVolumes(A.volume());
  return invertDiagonal(A);
}

}  // namespace palpate::solver
