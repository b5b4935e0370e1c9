// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: operations of a coarse space.

#include "palpate/base/float_lanes.h"
#include "pcg_arrays.h"
#include "pcg_products.h"

namespace palpate::solver::PALPATE_ISA {
namespace {

// r and arm x r of a window's slices, in two passes, to avoid loads of just stored halves, which
// stall.
inline void takeForces(const PcgCoarse& coarse, int begin, int end, const double* r,
                       float (*forces)[6 * kSlice]) {
  for (long s = begin; s < end; ++s) {
    for (int lane = 0; lane < 3 * kSlice; lane += kWidth) {
      const long at = 3 * kSlice * s + lane;
      storeAsFloats(forces[s - begin] + lane, load(r + at) * loadAsDoubles(coarse.mask + at));
    }
  }
  for (long s = begin; s < end; ++s) {
    float* of = forces[s - begin];
    for (int lane = 0; lane < kSlice; lane += kFloatWidth) {
      FloatLanes v[3], arm[3];
      for (int c = 0; c < 3; ++c) {
        v[c] = load(of + kSlice * c + lane);
        arm[c] = load(coarse.arm + kSlice * (3 * s + c) + lane);
      }
      for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        store(of + kSlice * (3 + c) + lane, arm[d] * v[e] - arm[e] * v[d]);
      }
    }
  }
}

// The same summation tree for all widths.
template <int kHalf>
inline float sumOfLanes(float* lanes) {
  for (int lane = 0; lane < kHalf; ++lane) lanes[lane] += lanes[lane + kHalf];
  if constexpr (kHalf > 1) return sumOfLanes<kHalf / 2>(lanes);
  return lanes[0];
}

void restrictTo(const PcgCoarse& coarse, int begin, int end, const double* r, double* sums) {
  alignas(64) float forces[kWindow / kSlice][6 * kSlice];
  takeForces(coarse, begin, end, r, forces);
  const int window = begin * kSlice / kWindow;
  for (int k = coarse.parts[window]; k < coarse.parts[window + 1]; ++k, sums += 6) {
    alignas(64) float all[6][kSlice];
    for (int lane = 0; lane < kSlice; lane += kFloatWidth) {
      FloatLanes sum[6] = {};
      for (long piece = coarse.pieces[k]; piece < coarse.pieces[k + 1]; ++piece) {
        const FloatLanes weight = load(coarse.weights + kSlice * piece + lane);
        const float* of = forces[coarse.slice[piece]];
        for (int c = 0; c < 6; ++c) sum[c] += weight * load(of + kSlice * c + lane);
      }
      for (int c = 0; c < 6; ++c) store(all[c] + lane, sum[c]);
    }
    for (int c = 0; c < 6; ++c) sums[c] = sumOfLanes<kSlice / 2>(all[c]);
  }
}

// Motion of the nodes of slice s.
inline void prolong(const PcgCoarse& coarse, long s, float* motion) {
  for (int lane = 0; lane < kSlice; lane += kFloatWidth) {
    FloatLanes of[6] = {}, arm[3];
    for (int k = coarse.start_of_slice[s]; k < coarse.start_of_slice[s + 1]; ++k) {
      const long piece = coarse.piece_of_slice[k];
      const FloatLanes weight = load(coarse.weights + kSlice * piece + lane);
      const float* motions = coarse.motions + 6L * coarse.part_of_slice[k];
      for (int c = 0; c < 6; ++c) of[c] += weight * motions[c];
    }
    for (int c = 0; c < 3; ++c) arm[c] = load(coarse.arm + kSlice * (3 * s + c) + lane);
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      const FloatLanes moved = of[c] + (of[3 + d] * arm[e] - of[3 + e] * arm[d]);
      store(motion + kSlice * c + lane, moved * load(coarse.mask + kSlice * (3 * s + c) + lane));
    }
  }
}

void multiplyDense(const float* A, int columns, int stride, int begin, int end, const float* x,
                   float* y) {
  constexpr int kRegisters = kDenseRows / kFloatWidth;
  for (int i = begin; i < end; i += kDenseRows) {
    FloatLanes sums[kRegisters] = {};
    for (int j = 0; j < columns; ++j) {
      const float* column = A + static_cast<long>(stride) * j + i;
      for (int k = 0; k < kRegisters; ++k) sums[k] += load(column + kFloatWidth * k) * x[j];
    }
    for (int k = 0; k < kRegisters; ++k) store(y + i + kFloatWidth * k, sums[k]);
  }
}

// In-place inverse by sweeps over all pivots above rounding [Goodnight 1979].
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
