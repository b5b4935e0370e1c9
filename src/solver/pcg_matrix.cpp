// SPDX-License-Identifier: GPL-3.0-or-later
#include "pcg_matrix.h"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

namespace palpate::solver {
namespace {

constexpr int kChunk = 256;        // nodes
constexpr int kWorthThreads = 16;  // chunks: below it, sharing costs more than it gains
constexpr std::size_t kPadding = 16;

int numChunks(int count) { return (count + kChunk - 1) / kChunk; }

void toFloats(const double* from, std::size_t count, float* to) {
  for (std::size_t k = 0; k < count; ++k) to[k] = static_cast<float>(from[k]);
}

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
  const fem::BlockMatrix& K = A.blocks();
  num_nodes_ = K.numNodes();
  row_start_.push_back(0);
  for (int i = 0; i < num_nodes_; ++i) row_start_.push_back(K.rowEnd(i));
  for (int slot = 0; slot < K.numBlocks(); ++slot) column_.push_back(K.column(slot));
  values_.assign(9 * column_.size() + kPadding, 0.0F);
  inverse_diagonal_.assign(9 * static_cast<std::size_t>(num_nodes_) + kPadding, 0.0F);
  partial_.resize(static_cast<std::size_t>(numChunks(num_nodes_)));
  partial_2_ = partial_;
  if (!A.hasVolume()) return;
  const fem::VolumeStiffness& volume = A.volume();
  num_pressures_ = static_cast<int>(volume.numRows());
  start_ = volume.pattern->start;
  node_ = volume.pattern->node;
  rows_.assign(3 * node_.size() + kPadding, 0.0F);
  columns_ = rows_;
  column_start_.assign(static_cast<std::size_t>(num_nodes_) + 1, 0);
  for (int n : node_) ++column_start_[n + 1];
  std::partial_sum(column_start_.begin(), column_start_.end(), column_start_.begin());
  std::vector<int> next(column_start_.begin(), column_start_.end() - 1);
  pressure_.resize(node_.size());
  source_.resize(node_.size());
  for (int p = 0; p < num_pressures_; ++p) {
    for (int k = start_[p]; k < start_[p + 1]; ++k) {
      const int at = next[node_[k]]++;
      pressure_[at] = p;
      source_[at] = k;
    }
  }
  c_.assign(static_cast<std::size_t>(num_pressures_), 0.0F);
  weights_ = c_;
}

bool PcgMatrix::invertDiagonal(const fem::Stiffness& A) {
  A.diagonal(&diagonal_);
  for (int i = 0; i < num_nodes_; ++i) {
    const Mat3& D = diagonal_[static_cast<std::size_t>(i)];
    // Sylvester's criterion: leading minors.
    const double minor = D(0, 0) * D(1, 1) - D(0, 1) * D(1, 0);
    if (!(D(0, 0) > 0.0 && minor > 0.0 && D.determinant() > 0.0)) return false;
    const Mat3 inverse = D.inverse();
    for (int k = 0; k < 9; ++k) {  // exactly symmetric
      inverse_diagonal_[9 * static_cast<std::size_t>(i) + k] =
          static_cast<float>(inverse(std::min(k % 3, k / 3), std::max(k % 3, k / 3)));
    }
  }
  return true;
}

void PcgMatrix::packVolumes(const fem::VolumeStiffness& volume) {
  const double* from = volume.rows.data();
  toFloats(from, 3 * node_.size(), rows_.data());
  for (std::size_t k = 0; k < source_.size(); ++k) {
    for (int c = 0; c < 3; ++c)
      columns_[3 * k + c] = rows_[3 * static_cast<std::size_t>(source_[k]) + c];
  }
  factor_ = volume.factor;
  metric_ = volume.metric->isDiagonal() ? nullptr : volume.metric.get();
  for (int p = 0; p < num_pressures_ && !metric_; ++p) {
    weights_[p] = static_cast<float>(factor_ * volume.metric->weights()[p]);
  }
}

bool PcgMatrix::assign(const fem::Stiffness& A) {
  if (num_nodes_ == 0) takePattern(A);
  toFloats(A.blocks().block(0).data(), 9 * column_.size(), values_.data());
  if (num_pressures_ > 0) packVolumes(A.volume());
  return invertDiagonal(A);
}

double PcgMatrix::apply(const PcgVectors& v) {
  const PcgBlocks K{row_start_.data(), column_.data(), values_.data()};
  const PcgVolumes B{
      start_.data(),        node_.data(),     rows_.data(),   metric_ ? nullptr : weights_.data(),
      column_start_.data(), pressure_.data(), columns_.data()};
  if (num_pressures_ > 0) {
    forChunks(num_pressures_, [&](int, int begin, int end) {
      kernels_.volumes(B, begin, end, v.p_single, c_.data());
    });
    if (metric_) {
      Eigen::Map<Eigen::VectorXf> c(c_.data(), num_pressures_);
      changes_ = c.cast<double>();
      metric_->apply(changes_, &pressures_);
      c = (factor_ * pressures_).cast<float>();
    }
  }
  forChunks(num_nodes_, [&](int chunk, int begin, int end) {
    partial_[chunk] = kernels_.apply(K, B, begin, end, num_pressures_ > 0 ? c_.data() : nullptr, v);
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
