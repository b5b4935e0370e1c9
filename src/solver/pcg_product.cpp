// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numeric>

#include "pcg_matrix.h"

namespace palpate::solver {

// Computes c = M c.
void PcgMatrix::applyMetric() {
  changes_.resize(pressures_.count());
  for (int p = 0; p < pressures_.count(); ++p) changes_[p] = c_[pressures_.position(p)];
  metric_->apply(changes_, &metric_times_changes_);
  for (int p = 0; p < pressures_.count(); ++p) {
    c_[pressures_.position(p)] = static_cast<float>(factor_ * metric_times_changes_[p]);
  }
}

// Computes Ap = K p and c = M B p of one thread's chunks, and Ap += B^T c as soon as all c of a
// chunk are known, so that both arrays are read in one pass.
void PcgMatrix::sweep(const PcgVolumes& B, int first, int last, const PcgVectors& v) {
  const int slices = nodes_.numSlices();
  for (int k = 0, next = 0; k < last - first; ++k) {
    const int now = chunks_.at(k, first, last);
    Chunks::slicesOf(now, slices, [&](int begin, int end) {
      kernels_.multiplyWithVolumes(rows_.rows(), B, begin, end, v);
    });
    for (; next <= k; ++next) {
      const int chunk = chunks_.at(next, first, last);
      const Reach& reach = reach_[chunk];
      const bool own = reach.first >= first && reach.last < last;
      added_[chunk] = own && !reach.others && !metric_ ? 1 : 0;
      if (added_[chunk] == 0) continue;
      if (chunks_.backwards() ? reach.first < now : reach.last > now) break;
      Chunks::slicesOf(chunk, slices, [&](int begin, int end) {
        partial_[chunk] = kernels_.addVolumes(B, begin, end, v);
      });
    }
  }
}

double PcgMatrix::applyWithVolumes(const PcgVectors& v) {
  const PcgVolumes B = volumes(metric_ ? nullptr : weights_.data());
  chunks_.forParts(nodes_.numSlices(), [&](int first, int last) { sweep(B, first, last, v); });
  chunks_.forAll(pressures_.others().numSlices(), [&](int, int begin, int end) {
    kernels_.changeOthers(B, pressures_.othersBegin(), begin, end, v);
  });
  if (metric_) applyMetric();
  if (std::find(added_.begin(), added_.end(), 0) != added_.end()) {
    chunks_.forAll(nodes_.numSlices(), [&](int chunk, int begin, int end) {
      if (added_[chunk] == 0) partial_[chunk] = kernels_.addVolumes(B, begin, end, v);
    });
  }
  return std::accumulate(partial_.begin(), partial_.end(), 0.0);
}

// Serial plain loops: couplings are few, and the sum is equal in all builds.
double PcgMatrix::addCouplings(const PcgVectors& v) const {
  double sum = 0.0;
  for (const Coupling& c : couplings_) {
    const double *p_row = v.p + c.row, *p_column = v.p + c.column;
    const Vec3 Ap = c.values * Vec3(p_column[0], p_column[kSlice], p_column[2 * kSlice]);
    for (int k = 0; k < 3; ++k) v.Ap[c.row + kSlice * k] += static_cast<float>(Ap[k]);
    sum += Vec3(p_row[0], p_row[kSlice], p_row[2 * kSlice]).dot(Ap);
  }
  return sum;
}

double PcgMatrix::addRankOnes(const PcgVectors& v) const {
  double curvature = 0.0;
  for (std::size_t t = 0; t < num_rank_ones_; ++t) {
    const RankOne& one = rank_ones_[t];
    double sum = 0.0;
    for (std::size_t k = 0; k < one.nodes.size(); ++k) {
      const double* p = v.p + one.nodes[k];
      sum += one.a.col(static_cast<Eigen::Index>(k)).dot(Vec3(p[0], p[kSlice], p[2 * kSlice]));
    }
    curvature += one.c * sum * sum;
    for (std::size_t k = 0; k < one.nodes.size(); ++k) {
      const Vec3 Ap = one.c * sum * one.a.col(static_cast<Eigen::Index>(k));
      for (int c = 0; c < 3; ++c) v.Ap[one.nodes[k] + kSlice * c] += static_cast<float>(Ap[c]);
    }
  }
  return curvature;
}

double PcgMatrix::apply(const PcgVectors& v) {
  chunks_.turn();
  double curvature = pressures_.count() > 0 ? applyWithVolumes(v) : applyBlocks(v);
  if (!couplings_.empty()) curvature += addCouplings(v);
  if (num_rank_ones_ > 0) curvature += addRankOnes(v);
  return curvature;
}

double PcgMatrix::applyBlocks(const PcgVectors& v) {
  chunks_.forAll(nodes_.numSlices(), [&](int chunk, int begin, int end) {
    partial_[chunk] = kernels_.multiply(rows_.rows(), begin, end, v);
  });
  return std::accumulate(partial_.begin(), partial_.end(), 0.0);
}

const PcgMatrix::Part& PcgMatrix::partAt(int slice) const {
  std::size_t k = parts_.size() - 1;
  while (slice < parts_[k].first_slice) --k;
  return parts_[k];
}

// Padding after the last node of a part is zero up to its last chunk's end.
void PcgMatrix::update(double alpha, const PcgVectors& v, double* rz, double* rr) {
  chunks_.forAll(nodes_.numSlices(), [&](int chunk, int begin, int end) {
    kernels_.update(inverse_diagonal_.data(), begin, end, alpha, v, &partial_[chunk],
                    &partial_2_[chunk]);
    const Part& part = partAt(begin);
    if (!part.coarse) return;
    const int first = part.first_slice;
    part.coarse->restrictTo(part.chunk(chunk), begin - first, std::min(end - first, part.slices),
                            v.r + static_cast<std::ptrdiff_t>(3 * kSlice) * first);
  });
  *rz = std::accumulate(partial_.begin(), partial_.end(), 0.0);
  *rr = std::accumulate(partial_2_.begin(), partial_2_.end(), 0.0);
  for (const Part& part : parts_) {
    if (part.coarse) *rz += part.coarse->correct();
  }
}

void PcgMatrix::direct(double alpha, double beta, const PcgVectors& v) {
  chunks_.forAll(nodes_.numSlices(), [&](int, int begin, int end) {
    const Part& part = partAt(begin);
    const int first = part.first_slice;
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(3 * kSlice) * first;
    const std::ptrdiff_t node = static_cast<std::ptrdiff_t>(kNodeStride * kSlice) * first;
    const PcgVectors own{v.x + at, v.r + at, v.p + at, v.z + at, v.Ap + at, v.p_nodes + node};
    kernels_.direct(begin - first, std::min(end - first, part.slices), alpha, beta, own,
                    part.coarse ? &part.coarse->correction() : nullptr);
  });
}

}  // namespace palpate::solver
