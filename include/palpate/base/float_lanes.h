// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: a register of floats, with conversions from and to doubles.

#include "palpate/base/lanes.h"

namespace palpate {
namespace {

constexpr int kFloatWidth = 2 * kWidth;

typedef float FloatLanes __attribute__((vector_size(4 * kFloatWidth)));
typedef float FloatLanesInMemory
    __attribute__((vector_size(4 * kFloatWidth), aligned(4), may_alias));

inline FloatLanes load(const float* p) { return *reinterpret_cast<const FloatLanesInMemory*>(p); }
inline void store(float* p, FloatLanes v) { *reinterpret_cast<FloatLanesInMemory*>(p) = v; }

/// Loads integers as floats.
inline FloatLanes loadAsFloats(const int* p) {
  typedef int Integers __attribute__((vector_size(4 * kFloatWidth)));
  typedef int IntegersInMemory __attribute__((vector_size(4 * kFloatWidth), aligned(4), may_alias));
  const Integers v = *reinterpret_cast<const IntegersInMemory*>(p);
  return __builtin_convertvector(v, FloatLanes);
}

/// Loads p[index[lane]].
inline FloatLanes gather(const float* p, const int* index) {
#if defined(__AVX512F__)
  return _mm512_i32gather_ps(_mm512_loadu_si512(index), p, 4);
#elif defined(__AVX2__)
  return _mm256_i32gather_ps(p, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index)), 4);
#else
  return FloatLanes{p[index[0]], p[index[1]], p[index[2]], p[index[3]]};
#endif
}

/// Loads p[index[lane]], or 0 for negative indices.
inline Lanes gatherOrZero(const double* p, const int* index) {
#if defined(__AVX512F__)
  const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
  const __mmask8 there = _mm256_cmpge_epi32_mask(at, _mm256_setzero_si256());
  return _mm512_mask_i32gather_pd(_mm512_setzero_pd(), there, at, p, 8);
#else
  Lanes v{};
  for (int lane = 0; lane < kWidth; ++lane) {
    if (index[lane] >= 0) v[lane] = p[index[lane]];
  }
  return v;
#endif
}

/// Loads as many floats as Lanes has doubles. Explicit, since GCC 12 does not vectorise it.
inline Lanes loadAsDoubles(const float* p) {
#if defined(__AVX512F__)
  return _mm512_cvtps_pd(_mm256_loadu_ps(p));
#elif defined(__AVX2__)
  return _mm256_cvtps_pd(_mm_loadu_ps(p));
#else
  return Lanes{p[0], p[1]};
#endif
}
inline void storeAsFloats(float* p, Lanes v) {
#if defined(__AVX512F__)
  _mm256_storeu_ps(p, _mm512_cvtpd_ps(v));
#elif defined(__AVX2__)
  _mm_storeu_ps(p, _mm256_cvtpd_ps(v));
#else
  for (int lane = 0; lane < kWidth; ++lane) p[lane] = static_cast<float>(v[lane]);
#endif
}

}  // namespace
}  // namespace palpate
