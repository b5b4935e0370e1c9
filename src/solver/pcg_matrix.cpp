// SPDX-License-Identifier: GPL-3.0-or-later
#include "pcg_matrix.h"

#include <algorithm>
#include <numeric>

namespace palpate::solver {
namespace {

constexpr int kChunk = 16;        // slices that one thread works through in one go
constexpr int kWorthThreads = 8;  // chunks: below it, sharing costs more than it gains

int numChunks(int slices) { return (slices + kChunk - 1) / kChunk; }

}  // namespace

template <class Body>
void PcgMatrix::forChunks(int slices, const Body& body) {
  const int chunks = numChunks(slices);
  const auto run = [&](std::size_t first, std::size_t last) {
    for (auto chunk = static_cast<int>(first); chunk < static_cast<int>(last); ++chunk) {
      body(chunk, kChunk * chunk, std::min(kChunk * (chunk + 1), slices));
    }
  };
  if (pool_ && chunks >= kWorthThreads) {
    pool_->forRanges(static_cast<std::size_t>(chunks), run);
  } else {
    run(0, static_cast<std::size_t>(chunks));
  }
}

void PcgMatrix::takePattern(const fem::Stiffness& A) {
  const fem::BlockMatrix& K = A.blocks();
  std::vector<int> lengths;
  for (int i = 0; i < K.numNodes(); ++i) lengths.push_back(K.rowEnd(i) - K.rowBegin(i));
  nodes_ = SliceOrder(lengths);
  std::vector<std::vector<SlicedRows::Entry>> blocks(lengths.size());
  for (int i = 0; i < K.numNodes(); ++i) {
    for (int slot = K.rowBegin(i); slot < K.rowEnd(i); ++slot) {
      blocks[i].push_back({static_cast<int>(nodes_.offset(K.column(slot), 3)), 9 * slot});
    }
  }
  blocks_ = SlicedRows(blocks, 9, nodes_);
  const std::size_t lanes = static_cast<std::size_t>(kSlice) * nodes_.numSlices();
  inverse_diagonal_.resize(6 * lanes);
  for (int p = 0; p < static_cast<int>(lanes); ++p) {
    diagonal_.push_back(9 * K.diagonal(std::max(nodes_.at(p), 0)));  // beyond the last: any
  }
  partial_.resize(static_cast<std::size_t>(numChunks(nodes_.numSlices())));
  partial_2_ = partial_;
  if (A.hasVolume()) takePattern(*A.volume().pattern);
}

void PcgMatrix::takePattern(const fem::VolumeStiffness::Pattern& pattern) {
  const auto count = static_cast<int>(pattern.start.size()) - 1;
  std::vector<int> lengths;
  for (int p = 0; p < count; ++p) lengths.push_back(pattern.start[p + 1] - pattern.start[p]);
  pressures_ = SliceOrder(lengths);
  std::vector<std::vector<SlicedRows::Entry>> rows(lengths.size());
  std::vector<std::vector<SlicedRows::Entry>> columns(static_cast<std::size_t>(nodes_.count()));
  for (int p = 0; p < count; ++p) {
    for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
      rows[p].push_back({static_cast<int>(nodes_.offset(pattern.node[k], 3)), 3 * k});
      columns[pattern.node[k]].push_back({pressures_.position(p), 3 * k});
    }
  }
  rows_ = SlicedRows(rows, 3, pressures_);
  columns_ = SlicedRows(columns, 3, nodes_);
  c_.assign(static_cast<std::size_t>(kSlice) * pressures_.numSlices(), 0.0F);
  weights_ = c_;
}

PcgVolumes PcgMatrix::volumes() const {
  return {rows_.rows(), columns_.rows(), metric_ ? nullptr : weights_.data()};
}

void PcgMatrix::packVolumes(const fem::VolumeStiffness& volume) {
  const double* values = volume.rows.data();
  forChunks(pressures_.numSlices(),
            [&](int, int begin, int end) { rows_.assign(begin, end, values, kernels_); });
  forChunks(nodes_.numSlices(),
            [&](int, int begin, int end) { columns_.assign(begin, end, values, kernels_); });
  factor_ = volume.factor;
  metric_ = volume.metric->isDiagonal() ? nullptr : volume.metric.get();
  for (int p = 0; p < pressures_.count(); ++p) {
    weights_[pressures_.position(p)] = static_cast<float>(factor_ * volume.metric->weights()[p]);
  }
}

bool PcgMatrix::invertDiagonal(const fem::Stiffness& A) {
  const PcgVolumes B{rows_.rows(), columns_.rows(), weights_.data()};
  forChunks(nodes_.numSlices(), [&](int chunk, int begin, int end) {
    partial_[chunk] =
        kernels_.invert(A.blocks().values(), diagonal_.data(), A.hasVolume() ? &B : nullptr, begin,
                        end, inverse_diagonal_.data());
  });
  return std::find(partial_.begin(), partial_.end(), 0.0) == partial_.end();
}

bool PcgMatrix::assign(const fem::Stiffness& A) {
  if (nodes_.count() == 0) takePattern(A);
  const double* values = A.blocks().values();
  forChunks(nodes_.numSlices(),
            [&](int, int begin, int end) { blocks_.assign(begin, end, values, kernels_); });
  if (A.hasVolume()) packVolumes(A.volume());
  return invertDiagonal(A);
}

// c = M c.
void PcgMatrix::applyMetric() {
  changes_.resize(pressures_.count());
  for (int p = 0; p < pressures_.count(); ++p) changes_[p] = c_[pressures_.position(p)];
  metric_->apply(changes_, &metric_times_changes_);
  for (int p = 0; p < pressures_.count(); ++p) {
    c_[pressures_.position(p)] = static_cast<float>(factor_ * metric_times_changes_[p]);
  }
}

double PcgMatrix::apply(const PcgVectors& v) {
  const PcgVolumes B = volumes();
  float* c = c_.empty() ? nullptr : c_.data();
  if (c) {
    forChunks(pressures_.numSlices(),
              [&](int, int begin, int end) { kernels_.volumes(B, begin, end, v.p_single, c); });
    if (metric_) applyMetric();
  }
  forChunks(nodes_.numSlices(), [&](int chunk, int begin, int end) {
    partial_[chunk] = kernels_.apply(blocks_.rows(), B, begin, end, c, v);
  });
  return std::accumulate(partial_.begin(), partial_.end(), 0.0);
}

void PcgMatrix::update(double alpha, const PcgVectors& v, double* rz, double* rr) {
  forChunks(nodes_.numSlices(), [&](int chunk, int begin, int end) {
    kernels_.update(inverse_diagonal_.data(), begin, end, alpha, v, &partial_[chunk],
                    &partial_2_[chunk]);
  });
  *rz = std::accumulate(partial_.begin(), partial_.end(), 0.0);
  *rr = std::accumulate(partial_2_.begin(), partial_2_.end(), 0.0);
}

void PcgMatrix::direct(double beta, const PcgVectors& v) {
  forChunks(nodes_.numSlices(),
            [&](int, int begin, int end) { kernels_.direct(begin, end, beta, v); });
}

}  // namespace palpate::solver
