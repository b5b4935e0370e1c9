// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: a register of doubles, as wide as the build's vector registers. All is local to
// the translation unit, see cmake/PalpateKernels.cmake.

#if defined(__AVX2__) || defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace palpate {
namespace {

#if defined(__AVX512F__)
constexpr int kWidth = 8;
#elif defined(__AVX2__)
constexpr int kWidth = 4;
#else
constexpr int kWidth = 2;
#endif

typedef double Lanes __attribute__((vector_size(8 * kWidth)));
typedef long long LaneBits __attribute__((vector_size(8 * kWidth)));
typedef double LanesInMemory __attribute__((vector_size(8 * kWidth), aligned(8), may_alias));

inline Lanes load(const double* p) { return *reinterpret_cast<const LanesInMemory*>(p); }
inline void store(double* p, Lanes v) { *reinterpret_cast<LanesInMemory*>(p) = v; }
inline Lanes all(double s) { return s - Lanes{}; }

/// Loads p[index[lane]].
inline Lanes gather(const double* p, const int* index) {
#if defined(__AVX512F__)
  const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
  return _mm512_i32gather_pd(at, p, 8);
#elif defined(__AVX2__)
  const __m128i at = _mm_loadu_si128(reinterpret_cast<const __m128i*>(index));
  return _mm256_i32gather_pd(p, at, 8);
#else
  return Lanes{p[index[0]], p[index[1]]};
#endif
}

/// Loads integers, one per lane.
inline LaneBits loadAsBits(const int* p) {
  typedef int Integers __attribute__((vector_size(4 * kWidth)));
  typedef int IntegersInMemory __attribute__((vector_size(4 * kWidth), aligned(4), may_alias));
  const Integers v = *reinterpret_cast<const IntegersInMemory*>(p);
  return __builtin_convertvector(v, LaneBits);
}
/// Mask of negative indices.
inline LaneBits belowZero(const int* index) { return loadAsBits(index) < 0; }

/// condition ? a : b, per lane.
inline Lanes select(LaneBits condition, Lanes a, Lanes b) {
  return (Lanes)(((LaneBits)a & condition) | ((LaneBits)b & ~condition));
}

/// Rounded as in IEEE 754.
inline Lanes squareRoot(Lanes x) {
#if defined(__AVX512F__)
  return _mm512_sqrt_pd(x);
#elif defined(__AVX2__)
  return _mm256_sqrt_pd(x);
#else
  return Lanes{__builtin_sqrt(x[0]), __builtin_sqrt(x[1])};
#endif
}

/// x^(-1/3) for normal x > 0, to rounding: an initial value by the exponent (3 % error), then y <-
/// y (1 + e/3 + 2/9 e^2), e = 1 - x y^3, with cubic convergence.
inline Lanes inverseCubeRoot(Lanes x) {
  const LaneBits high = (LaneBits)x >> 32;
  const LaneBits third = (high * 0x55555556LL) >> 32;
  Lanes y = (Lanes)((0x553EF0FFLL - third) << 32);
  for (int k = 0; k < 3; ++k) {
    const Lanes e = 1.0 - (x * y) * (y * y);
    y += y * (e * (1.0 / 3.0 + (2.0 / 9.0) * e));
  }
  return y;
}

/// at[index[lane]][i] += values[i][lane] for i < 9 and the first `count` of eight lanes.
inline void addNines(const double (*values)[8], const int* index, int count, double* at) {
#if defined(__AVX512F__)
  __m512d r[8], t[8];
  for (int i = 0; i < 8; ++i) r[i] = _mm512_load_pd(values[i]);
  for (int i = 0; i < 4; ++i) {
    t[2 * i] = _mm512_unpacklo_pd(r[2 * i], r[2 * i + 1]);
    t[2 * i + 1] = _mm512_unpackhi_pd(r[2 * i], r[2 * i + 1]);
  }
  for (int i = 0; i < 2; ++i) {
    r[i] = _mm512_shuffle_f64x2(t[i], t[2 + i], 0x88);
    r[2 + i] = _mm512_shuffle_f64x2(t[i], t[2 + i], 0xdd);
    r[4 + i] = _mm512_shuffle_f64x2(t[4 + i], t[6 + i], 0x88);
    r[6 + i] = _mm512_shuffle_f64x2(t[4 + i], t[6 + i], 0xdd);
  }
  for (int i = 0; i < 4; ++i) {
    t[i] = _mm512_shuffle_f64x2(r[i], r[4 + i], 0x88);
    t[4 + i] = _mm512_shuffle_f64x2(r[i], r[4 + i], 0xdd);
  }
  for (int e = 0; e < count; ++e) {
    double* out = at + index[e];
    _mm512_storeu_pd(out, _mm512_add_pd(_mm512_loadu_pd(out), t[e]));
    out[8] += values[8][e];
  }
#else
  for (int e = 0; e < count; ++e) {
    double* out = at + index[e];
    for (int i = 0; i < 9; ++i) out[i] += values[i][e];
  }
#endif
}

}  // namespace
}  // namespace palpate
