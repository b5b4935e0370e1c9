// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/lanes.h"
#include "pcg_arrays.h"

namespace palpate::solver::PALPATE_ISA {
namespace {

typedef double Quad __attribute__((vector_size(32)));
typedef double QuadInMemory __attribute__((vector_size(32), aligned(8), may_alias));
typedef float Floats __attribute__((vector_size(16)));
typedef float FloatsInMemory __attribute__((vector_size(16), aligned(4), may_alias));

inline Quad loadQuad(const double* p) { return *reinterpret_cast<const QuadInMemory*>(p); }
inline void storeQuad(double* p, const Quad& v) { *reinterpret_cast<QuadInMemory*>(p) = v; }
inline Floats loadFloats(const float* p) { return *reinterpret_cast<const FloatsInMemory*>(p); }
inline void storeFloats(float* p, Floats v) { *reinterpret_cast<FloatsInMemory*>(p) = v; }
// GCC 12 does not find the instruction in __builtin_convertvector().
inline Quad toDouble(Floats v) {
#if defined(__AVX2__)
  return _mm256_cvtps_pd(v);
#else
  return Quad{v[0], v[1], v[2], v[3]};
#endif
}
inline Floats toFloat(const Quad& v) {
#if defined(__AVX2__)
  return _mm256_cvtpd_ps(v);
#else
  return Floats{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]),
                static_cast<float>(v[3])};
#endif
}
// The fourth component of what was loaded belongs to the next entry.
constexpr Quad kFirstThree = {1.0, 1.0, 1.0, 0.0};
inline double sum(const Quad& v) { return (v[0] + v[1]) + (v[2] + v[3]); }
inline float sum(Floats v) { return (v[0] + v[1]) + (v[2] + v[3]); }

void pack9(const int* from, int begin, int end, const double* values, float* to) {
  for (int k = begin; k < end; ++k) {
    if (from[k] < 0) continue;
    const double* source = values + 9L * from[k];
    float* target = to + 9L * k;
#if defined(__AVX512F__)
    _mm256_storeu_ps(target, _mm512_cvtpd_ps(_mm512_loadu_pd(source)));
    target[8] = static_cast<float>(source[8]);
#else
    for (int c = 0; c < 9; ++c) target[c] = static_cast<float>(source[c]);
#endif
  }
}

void pack3(const int* from, int begin, int end, const double* values, float* to) {
  for (int k = begin; k < end; ++k) {
    if (from[k] < 0) continue;
    const double* source = values + 3L * from[k];
    float* target = to + 3L * k;
#if defined(__AVX512F__)
    _mm_mask_storeu_ps(target, 7, _mm256_cvtpd_ps(_mm256_maskz_loadu_pd(7, source)));
#else
    for (int c = 0; c < 3; ++c) target[c] = static_cast<float>(source[c]);
#endif
  }
}

// Sum of the row's blocks times their parts of p: entries in turn into one of two sums, each by
// columns, then the two, then the three columns.
inline Floats multiplyRow(const PcgRows& K, int row, const float* p) {
  const int end = K.start[row + 1];
#if defined(__AVX512F__)
  const __m512i spread = _mm512_setr_epi32(0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3);
  __m512 even = _mm512_setzero_ps(), odd = _mm512_setzero_ps();
  for (int k = K.start[row]; k < end; k += 2) {
    __builtin_prefetch(K.values + 9 * k + 288);  // some rows ahead
    const __m512 x0 = _mm512_castps128_ps512(_mm_loadu_ps(p + K.source[k]));
    const __m512 x1 = _mm512_castps128_ps512(_mm_loadu_ps(p + K.source[k + 1]));
    const __m512 A0 = _mm512_loadu_ps(K.values + 9 * k);
    const __m512 A1 = _mm512_loadu_ps(K.values + 9 * k + 9);
    even = _mm512_add_ps(even, _mm512_mul_ps(A0, _mm512_permutexvar_ps(spread, x0)));
    odd = _mm512_add_ps(odd, _mm512_mul_ps(A1, _mm512_permutexvar_ps(spread, x1)));
  }
  const __m512 y = _mm512_add_ps(even, odd);
  const __m512i second = _mm512_setr_epi32(3, 4, 5, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9);
  const __m512i third = _mm512_setr_epi32(6, 7, 8, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9);
  const __m512 two = _mm512_add_ps(y, _mm512_permutexvar_ps(second, y));
  return _mm512_castps512_ps128(_mm512_add_ps(two, _mm512_permutexvar_ps(third, y)));
#else
  Floats even[3] = {}, odd[3] = {};
  for (int k = K.start[row]; k < end; k += 2) {
    const float* A = K.values + 9 * k;
    const float* x0 = p + K.source[k];
    const float* x1 = p + K.source[k + 1];
    for (int c = 0; c < 3; ++c) {
      even[c] += loadFloats(A + 3 * c) * x0[c];
      odd[c] += loadFloats(A + 9 + 3 * c) * x1[c];
    }
  }
  return ((even[0] + odd[0]) + (even[1] + odd[1])) + (even[2] + odd[2]);
#endif
}

void volumes(const PcgVolumes& B, int begin, int end, const float* p, float* c) {
  for (int row = begin; row < end; ++row) {
    Floats even{}, odd{};
    for (int k = B.rows.start[row]; k < B.rows.start[row + 1]; k += 2) {
      even += loadFloats(B.rows.values + 3 * k) * loadFloats(p + B.rows.source[k]);
      odd += loadFloats(B.rows.values + 3 * k + 3) * loadFloats(p + B.rows.source[k + 1]);
    }
    const float change = sum(even + odd);
    const int target = B.rows.target[row];
    c[target] = B.weights ? B.weights[target] * change : change;
  }
}

double apply(const PcgRows& K, const PcgVolumes& B, int begin, int end, const float* c,
             const PcgVectors& v) {
  Quad curvature{};
  for (int row = begin; row < end; ++row) {
    Floats y = multiplyRow(K, row, v.p_single);
    if (c) {
      Floats even{}, odd{};
      for (int k = B.columns.start[row]; k < B.columns.start[row + 1]; k += 2) {
        even += loadFloats(B.columns.values + 3 * k) * c[B.columns.source[k]];
        odd += loadFloats(B.columns.values + 3 * k + 3) * c[B.columns.source[k + 1]];
      }
      y += even + odd;
    }
    const int at = 4 * K.target[row];
    const Quad Ap = toDouble(y) * kFirstThree;
    storeQuad(v.Ap + at, Ap);
    curvature += Ap * loadQuad(v.p + at);
  }
  return sum(curvature);
}

void diagonal(const PcgVolumes& B, int begin, int end, float* blocks) {
  for (int row = begin; row < end; ++row) {
    float* D = blocks + 9 * B.columns.target[row];
    Floats columns[3] = {};
    for (int k = B.columns.start[row]; k < B.columns.start[row + 1]; ++k) {
      const float* b = B.columns.values + 3 * k;
      const Floats weighted = loadFloats(b) * B.weights[B.columns.source[k]];
      for (int c = 0; c < 3; ++c) columns[c] += weighted * b[c];
    }
    for (int c = 0; c < 9; ++c) D[c] += columns[c / 3][c % 3];
  }
}

inline Quad multiply(const float* A, const double* x) {
  return toDouble(loadFloats(A)) * x[0] + toDouble(loadFloats(A + 3)) * x[1] +
         toDouble(loadFloats(A + 6)) * x[2];
}

void update(const float* inverse_diagonal, int begin, int end, double alpha, const PcgVectors& v,
            double* rz, double* rr) {
  Quad rz_sum{}, rr_sum{};
  for (int i = begin; i < end; ++i) {
    const int at = 4 * i;
    storeQuad(v.x + at, loadQuad(v.x + at) + alpha * loadQuad(v.p + at));
    const Quad r = loadQuad(v.r + at) - alpha * loadQuad(v.Ap + at);
    storeQuad(v.r + at, r);
    const Quad z = multiply(inverse_diagonal + 9 * i, v.r + at) * kFirstThree;
    storeQuad(v.z + at, z);
    rz_sum += r * z;
    rr_sum += r * r;
  }
  *rz = sum(rz_sum);
  *rr = sum(rr_sum);
}

void direct(int begin, int end, double beta, const PcgVectors& v) {
  for (int k = 4 * begin; k < 4 * end; k += 4) {
    const Quad p = loadQuad(v.z + k) + beta * loadQuad(v.p + k);
    storeQuad(v.p + k, p);
    storeFloats(v.p_single + k, toFloat(p));
  }
}

}  // namespace

extern const PcgKernels kPcgKernels;
const PcgKernels kPcgKernels{pack9, pack3, volumes, apply, diagonal, update, direct};

}  // namespace palpate::solver::PALPATE_ISA
