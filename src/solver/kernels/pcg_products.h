// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: products with sliced rows.

#include "node_lanes.h"
#include "pcg_arrays.h"

namespace palpate::solver::PALPATE_ISA {
namespace {

// Sums over nodes by lane, independent of the register width.
struct alignas(64) LaneSums {
  double lanes[kSlice] = {};

  void add(int lane, Lanes v) { store(lanes + lane, load(lanes + lane) + v); }
  double total() const {
    double sum = 0.0;
    for (double v : lanes) sum += v;
    return sum;
  }
};

constexpr int kAhead = 8;  // prefetched entries

// Products of the rows of slice s with p, for the lanes of one register: three sums of blocks and,
// for kSize 12, the sum of rows of B.
template <int kSize>
inline void addRows(const PcgRows& K, int s, int lane, const float* p, FloatLanes* y,
                    FloatLanes* change) {
  for (long k = K.start[s]; k < K.start[s + 1]; ++k) {
    const float* A = K.values + kSize * kSlice * k + lane;
    for (int c = 0; c < kSize; ++c) __builtin_prefetch(A + kSlice * (kSize * kAhead + c));
    FloatLanes x[3];
    gatherNodes(p, K.source + kSlice * k + lane, x);
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3 && kSize >= 9; ++i) y[i] += load(A + kSlice * (3 * j + i)) * x[j];
      if (kSize != 9) change[j] += load(A + kSlice * (kSize - 3 + j)) * x[j];
    }
  }
}

inline void storeChange(const FloatLanes* change, const float* weights, long at, float* c) {
  FloatLanes sum = (change[0] + change[1]) + change[2];
  if (weights) sum *= load(weights + at);
  store(c + at, sum);
}

// Stores Ap of slice s and adds its part of p . Ap.
inline void finish(int s, const float* Ap, const PcgVectors& v, LaneSums* curvature) {
  for (int lane = 0; lane < 3 * kSlice; lane += kWidth) {
    curvature->add(lane % kSlice, loadAsDoubles(Ap + lane) * load(v.p + 3L * kSlice * s + lane));
  }
}

double multiply(const PcgRows& K, int begin, int end, const PcgVectors& v) {
  LaneSums curvature;
  for (int s = begin; s < end; ++s) {
    float* Ap = v.Ap + 3L * kSlice * s;
    for (int lane = 0; lane < kSlice; lane += kFloatWidth) {
      FloatLanes y[3] = {};
      addRows<9>(K, s, lane, v.p_nodes, y, nullptr);
      for (int i = 0; i < 3; ++i) store(Ap + kSlice * i + lane, y[i]);
    }
    finish(s, Ap, v, &curvature);
  }
  return curvature.total();
}

void multiplyWithVolumes(const PcgRows& K, const PcgVolumes& B, int begin, int end,
                         const PcgVectors& v) {
  for (int s = begin; s < end; ++s) {
    for (int lane = 0; lane < kSlice; lane += kFloatWidth) {
      FloatLanes y[3] = {}, change[3] = {};
      addRows<12>(K, s, lane, v.p_nodes, y, change);
      for (int i = 0; i < 3; ++i) store(v.Ap + kSlice * (3L * s + i) + lane, y[i]);
      storeChange(change, B.weights, static_cast<long>(kSlice) * s + lane, B.c);
    }
  }
}

void changeOthers(const PcgVolumes& B, int first, int begin, int end, const PcgVectors& v) {
  for (int s = begin; s < end; ++s) {
    for (int lane = 0; lane < kSlice; lane += kFloatWidth) {
      FloatLanes change[3] = {};
      addRows<3>(B.others, s, lane, v.p_nodes, nullptr, change);
      storeChange(change, B.weights, static_cast<long>(kSlice) * (first + s) + lane, B.c);
    }
  }
}

double addVolumes(const PcgVolumes& B, int begin, int end, const PcgVectors& v) {
  LaneSums curvature;
  for (int s = begin; s < end; ++s) {
    float* Ap = v.Ap + 3L * kSlice * s;
    for (int lane = 0; lane < kSlice; lane += kFloatWidth) {
      FloatLanes y[3];
      for (int i = 0; i < 3; ++i) y[i] = load(Ap + kSlice * i + lane);
      for (long k = B.columns.start[s]; k < B.columns.start[s + 1]; ++k) {
        const float* b = B.columns.values + 3 * kSlice * k + lane;
        const FloatLanes c = gather(B.c, B.columns.source + kSlice * k + lane);
        for (int i = 0; i < 3; ++i) y[i] += load(b + kSlice * i) * c;
      }
      for (int i = 0; i < 3; ++i) store(Ap + kSlice * i + lane, y[i]);
    }
    finish(s, Ap, v, &curvature);
  }
  return curvature.total();
}

}  // namespace
}  // namespace palpate::solver::PALPATE_ISA
