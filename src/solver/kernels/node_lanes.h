// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: loads and stores of nodes of four floats as registers of one component each.
// One load and a transposition replace three gathers per node.

#include "palpate/base/float_lanes.h"

namespace palpate {
namespace {

/// v[c][lane] = p[at[lane] + c] for c < 3.
inline void gatherNodes(const float* p, const int* at, FloatLanes* v) {
#if defined(__AVX512F__)
  __m512 q[4];
  for (int i = 0; i < 4; ++i) {
    q[i] = _mm512_castps128_ps512(_mm_loadu_ps(p + at[i]));
    q[i] = _mm512_insertf32x4(q[i], _mm_loadu_ps(p + at[4 + i]), 1);
    q[i] = _mm512_insertf32x4(q[i], _mm_loadu_ps(p + at[8 + i]), 2);
    q[i] = _mm512_insertf32x4(q[i], _mm_loadu_ps(p + at[12 + i]), 3);
  }
  const __m512d xy01 = _mm512_castps_pd(_mm512_unpacklo_ps(q[0], q[1]));
  const __m512d xy23 = _mm512_castps_pd(_mm512_unpacklo_ps(q[2], q[3]));
  const __m512d z01 = _mm512_castps_pd(_mm512_unpackhi_ps(q[0], q[1]));
  const __m512d z23 = _mm512_castps_pd(_mm512_unpackhi_ps(q[2], q[3]));
  v[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(xy01, xy23));
  v[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(xy01, xy23));
  v[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(z01, z23));
#elif defined(__AVX2__)
  __m256 q[4];
  for (int i = 0; i < 4; ++i) {
    q[i] = _mm256_castps128_ps256(_mm_loadu_ps(p + at[i]));
    q[i] = _mm256_insertf128_ps(q[i], _mm_loadu_ps(p + at[4 + i]), 1);
  }
  const __m256d xy01 = _mm256_castps_pd(_mm256_unpacklo_ps(q[0], q[1]));
  const __m256d xy23 = _mm256_castps_pd(_mm256_unpacklo_ps(q[2], q[3]));
  const __m256d z01 = _mm256_castps_pd(_mm256_unpackhi_ps(q[0], q[1]));
  const __m256d z23 = _mm256_castps_pd(_mm256_unpackhi_ps(q[2], q[3]));
  v[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(xy01, xy23));
  v[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(xy01, xy23));
  v[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(z01, z23));
#else
  FloatLanes q[4];
  for (int i = 0; i < 4; ++i) q[i] = load(p + at[i]);
  const FloatLanes xy01 = __builtin_shufflevector(q[0], q[1], 0, 4, 1, 5);
  const FloatLanes xy23 = __builtin_shufflevector(q[2], q[3], 0, 4, 1, 5);
  const FloatLanes z01 = __builtin_shufflevector(q[0], q[1], 2, 6, 3, 7);
  const FloatLanes z23 = __builtin_shufflevector(q[2], q[3], 2, 6, 3, 7);
  v[0] = __builtin_shufflevector(xy01, xy23, 0, 1, 4, 5);
  v[1] = __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7);
  v[2] = __builtin_shufflevector(z01, z23, 0, 1, 4, 5);
#endif
}

/// p[4 lane + c] = v[c][lane] for c < 3; p[4 lane + 3] = 0.
inline void storeNodes(const FloatLanes* v, float* p) {
  for (int lane = 0; lane < kFloatWidth; ++lane) {
    for (int c = 0; c < 3; ++c) p[4 * lane + c] = v[c][lane];
    p[4 * lane + 3] = 0.0F;
  }
}

}  // namespace
}  // namespace palpate
