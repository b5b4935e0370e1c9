// SPDX-License-Identifier: GPL-3.0-or-later
#include "pcg_matrix.h"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

namespace palpate::solver {
namespace {

constexpr int kWorthThreads = 8;  // chunks: below it, sharing costs more than it gains
constexpr std::size_t kPadding = 16;

int numChunks(int count) { return (count + kChunk - 1) / kChunk; }

}  // namespace

template <class Body>
void PcgMatrix::forChunks(int count, const Body& body) {
  const int chunks = numChunks(count);
  const auto run = [&](std::size_t first, std::size_t last) {
    for (auto chunk = static_cast<int>(first); chunk < static_cast<int>(last); ++chunk) {
      body(chunk, kChunk * chunk, std::min(kChunk * (chunk + 1), count));
    }
  };
  if (pool_ && chunks >= kWorthThreads) {
    pool_->forRanges(static_cast<std::size_t>(chunks), run);
  } else {
    run(0, static_cast<std::size_t>(chunks));
  }
}

void PcgMatrix::takePattern(const fem::Stiffness& A) {
  using Rows = std::vector<std::vector<PackedRows::Entry>>;
  const fem::BlockMatrix& K = A.blocks();
  num_nodes_ = K.numNodes();
  Rows blocks(static_cast<std::size_t>(num_nodes_));
  for (int i = 0; i < num_nodes_; ++i) {
    for (int slot = K.rowBegin(i); slot < K.rowEnd(i); ++slot) {
      blocks[i].push_back({K.column(slot), slot});
    }
  }
  blocks_ = PackedRows(blocks, 9, 4, blocks);
  inverse_diagonal_.assign(9 * static_cast<std::size_t>(num_nodes_) + kPadding, 0.0F);
  partial_.resize(static_cast<std::size_t>(numChunks(num_nodes_)));
  partial_2_ = partial_;
  if (!A.hasVolume()) return;
  const fem::VolumeStiffness::Pattern& pattern = *A.volume().pattern;
  num_pressures_ = static_cast<int>(A.volume().numRows());
  Rows rows(static_cast<std::size_t>(num_pressures_)), columns(blocks.size());
  for (int p = 0; p < num_pressures_; ++p) {
    for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
      rows[p].push_back({pattern.node[k], k});
      columns[pattern.node[k]].push_back({p, k});
    }
  }
  rows_ = PackedRows(rows, 3, 4, rows);
  columns_ = PackedRows(columns, 3, 1, blocks);
  c_.assign(static_cast<std::size_t>(num_pressures_), 0.0F);
  weights_ = c_;
}

PcgVolumes PcgMatrix::volumes() const {
  return {rows_.rows(), columns_.rows(), metric_ ? nullptr : weights_.data()};
}

void PcgMatrix::packVolumes(const fem::VolumeStiffness& volume) {
  const double* values = volume.rows.data();
  forChunks(num_pressures_, [&](int chunk, int, int) { rows_.assign(chunk, values, kernels_); });
  forChunks(num_nodes_, [&](int chunk, int, int) { columns_.assign(chunk, values, kernels_); });
  factor_ = volume.factor;
  metric_ = volume.metric->isDiagonal() ? nullptr : volume.metric.get();
  for (int p = 0; p < num_pressures_; ++p) {
    weights_[p] = static_cast<float>(factor_ * volume.metric->weights()[p]);
  }
}

bool PcgMatrix::invertDiagonal(const fem::Stiffness& A) {
  const fem::BlockMatrix& K = A.blocks();
  const PcgVolumes B{rows_.rows(), columns_.rows(), weights_.data()};
  forChunks(num_nodes_, [&](int chunk, int begin, int end) {
    float* D = inverse_diagonal_.data();
    for (int i = begin; i < end; ++i) {
      Eigen::Map<Eigen::Matrix3f>(D + 9 * static_cast<std::ptrdiff_t>(i)) =
          K.block(K.diagonal(i)).cast<float>();
    }
    if (num_pressures_ > 0) kernels_.diagonal(B, begin, end, D);
    bool definite = true;
    for (int i = begin; i < end; ++i) {
      Eigen::Map<Eigen::Matrix3f> block(D + 9 * static_cast<std::ptrdiff_t>(i));
      const Mat3 d = block.cast<double>();
      // Sylvester's criterion: leading minors.
      const double minor = d(0, 0) * d(1, 1) - d(0, 1) * d(1, 0);
      definite = definite && d(0, 0) > 0.0 && minor > 0.0 && d.determinant() > 0.0;
      const Mat3 inverse = d.inverse();
      block = (0.5 * (inverse + inverse.transpose())).cast<float>();  // exactly symmetric
    }
    partial_[chunk] = definite ? 1.0 : 0.0;
  });
  return std::find(partial_.begin(), partial_.end(), 0.0) == partial_.end();
}

bool PcgMatrix::assign(const fem::Stiffness& A) {
  if (num_nodes_ == 0) takePattern(A);
  const double* values = A.blocks().values();
  forChunks(num_nodes_, [&](int chunk, int, int) { blocks_.assign(chunk, values, kernels_); });
  if (num_pressures_ > 0) packVolumes(A.volume());
  return invertDiagonal(A);
}

double PcgMatrix::apply(const PcgVectors& v) {
  const PcgVolumes B = volumes();
  float* c = num_pressures_ > 0 ? c_.data() : nullptr;
  if (c) {
    forChunks(num_pressures_,
              [&](int, int begin, int end) { kernels_.volumes(B, begin, end, v.p_single, c); });
    if (metric_) {
      Eigen::Map<Eigen::VectorXf> all(c, num_pressures_);
      changes_ = all.cast<double>();
      metric_->apply(changes_, &pressures_);
      all = (factor_ * pressures_).cast<float>();
    }
  }
  forChunks(num_nodes_, [&](int chunk, int begin, int end) {
    partial_[chunk] = kernels_.apply(blocks_.rows(), B, begin, end, c, v);
  });
  return std::accumulate(partial_.begin(), partial_.end(), 0.0);
}

void PcgMatrix::update(double alpha, const PcgVectors& v, double* rz, double* rr) {
  forChunks(num_nodes_, [&](int chunk, int begin, int end) {
    kernels_.update(inverse_diagonal_.data(), begin, end, alpha, v, &partial_[chunk],
                    &partial_2_[chunk]);
  });
  *rz = std::accumulate(partial_.begin(), partial_.end(), 0.0);
  *rr = std::accumulate(partial_2_.begin(), partial_2_.end(), 0.0);
}

void PcgMatrix::direct(double beta, const PcgVectors& v) {
  forChunks(num_nodes_, [&](int, int begin, int end) { kernels_.direct(begin, end, beta, v); });
}

}  // namespace palpate::solver
