// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: what a coarse space does.

#include "palpate/base/float_lanes.h"
#include "pcg_arrays.h"
#include "pcg_products.h"

namespace palpate::solver::PALPATE_ISA {
namespace {

void restrictTo(const PcgCoarse& coarse, int begin, int end, const double* r, double* sums) {
  LaneSums all[12];
  for (int lane = 0; lane < kSlice; lane += kWidth) {
    Lanes sum[2][6] = {};
    for (long s = begin; s < end; ++s) {
      const LaneBits second = loadAsBits(coarse.second + kSlice * s + lane) > 0;
      Lanes v[6], arm[3];
      for (int c = 0; c < 3; ++c) {
        const long at = kSlice * (3 * s + c) + lane;
        v[c] = load(r + at) * loadAsDoubles(coarse.mask + at);
        arm[c] = loadAsDoubles(coarse.arm + at);
      }
      for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        v[3 + c] = arm[d] * v[e] - arm[e] * v[d];
      }
      for (int c = 0; c < 6; ++c) {
        sum[0][c] += select(second, Lanes{}, v[c]);
        sum[1][c] += select(second, v[c], Lanes{});
      }
    }
    for (int k = 0; k < 12; ++k) store(all[k].lanes + lane, sum[k / 6][k % 6]);
  }
  for (int k = 0; k < 12; ++k) sums[k] = all[k].total();
}

// What it moves the nodes of slice s by.
inline void prolong(const PcgCoarse& coarse, long s, float* motion) {
  const float* y = coarse.y + 6 * (s * kSlice / kWindow * kWindow / coarse.nodes);
  for (int lane = 0; lane < kSlice; lane += kFloatWidth) {
    const FloatLanes part = loadAsFloats(coarse.second + kSlice * s + lane);
    FloatLanes of[6], arm[3];
    for (int c = 0; c < 6; ++c) of[c] = y[c] + part * (y[6 + c] - y[c]);
    for (int c = 0; c < 3; ++c) arm[c] = load(coarse.arm + kSlice * (3 * s + c) + lane);
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      const FloatLanes moved = of[c] + (of[3 + d] * arm[e] - of[3 + e] * arm[d]);
      store(motion + kSlice * c + lane, moved * load(coarse.mask + kSlice * (3 * s + c) + lane));
    }
  }
}

void multiplyDense(const float* A, int columns, int stride, const float* x, float* y) {
  constexpr int kRegisters = kDenseRows / kFloatWidth;
  for (int i = 0; i < stride; i += kDenseRows) {
    FloatLanes sums[kRegisters] = {};
    for (int j = 0; j < columns; ++j) {
      const float* column = A + static_cast<long>(stride) * j + i;
      for (int k = 0; k < kRegisters; ++k) sums[k] += load(column + kFloatWidth * k) * x[j];
    }
    for (int k = 0; k < kRegisters; ++k) store(y + i + kFloatWidth * k, sums[k]);
  }
}

// In place, by sweeps over all pivots but those that are nothing but rounding [Goodnight 1979].
void invertDense(int n, int stride, double* A) {
  constexpr double kRounding = 1e-10;
  const auto column = [&](int j) { return A + static_cast<long>(stride) * j; };
  double largest = 0.0;
  for (int k = 0; k < n; ++k) largest = column(k)[k] > largest ? column(k)[k] : largest;
  for (int k = 0; k < n; ++k) {
    double* pivot = column(k);
    if (!(pivot[k] > kRounding * largest)) {
      for (int j = 0; j < n; ++j) column(j)[k] = pivot[j] = 0.0;
      continue;
    }
    const double inverse = 1.0 / pivot[k];
    for (int j = 0; j < n; ++j) {
      if (j == k) continue;
      double* of = column(j);
      const double factor = of[k] * inverse;
      for (int i = 0; i < stride; i += kWidth)
        store(of + i, load(of + i) - factor * load(pivot + i));
      of[k] = factor;
    }
    for (int i = 0; i < stride; i += kWidth) store(pivot + i, load(pivot + i) * inverse);
    pivot[k] = -inverse;
  }
  for (long at = 0; at < static_cast<long>(stride) * n; at += kWidth) store(A + at, -load(A + at));
}

}  // namespace
}  // namespace palpate::solver::PALPATE_ISA
