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

// Sum of the blocks from `begin` to `end` times their parts of p: column by column, then the sum of
// the three columns.
inline Floats multiplyRow(const PcgBlocks& K, int begin, int end, const float* p) {
#if defined(__AVX512F__)
  const __m512i spread = _mm512_setr_epi32(0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3);
  __m512 y = _mm512_setzero_ps();
  for (int k = begin; k < end; ++k) {
    const __m512 x = _mm512_castps128_ps512(_mm_loadu_ps(p + 4 * K.column[k]));
    const __m512 A = _mm512_loadu_ps(K.values + 9 * k);
    y = _mm512_add_ps(y, _mm512_mul_ps(A, _mm512_permutexvar_ps(spread, x)));
  }
  const __m512i second = _mm512_setr_epi32(3, 4, 5, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9);
  const __m512i third = _mm512_setr_epi32(6, 7, 8, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9);
  const __m512 two = _mm512_add_ps(y, _mm512_permutexvar_ps(second, y));
  return _mm512_castps512_ps128(_mm512_add_ps(two, _mm512_permutexvar_ps(third, y)));
#else
  Floats y0{}, y1{}, y2{};
  for (int k = begin; k < end; ++k) {
    const float* A = K.values + 9 * k;
    const float* x = p + 4 * K.column[k];
    y0 += loadFloats(A) * x[0];
    y1 += loadFloats(A + 3) * x[1];
    y2 += loadFloats(A + 6) * x[2];
  }
  return (y0 + y1) + y2;
#endif
}

void volumes(const PcgVolumes& B, int begin, int end, const float* p, float* c) {
  for (int row = begin; row < end; ++row) {
    Floats even{}, odd{};
    int k = B.start[row];
    for (; k + 1 < B.start[row + 1]; k += 2) {
      even += loadFloats(B.rows + 3 * k) * loadFloats(p + 4 * B.node[k]);
      odd += loadFloats(B.rows + 3 * k + 3) * loadFloats(p + 4 * B.node[k + 1]);
    }
    if (k < B.start[row + 1]) even += loadFloats(B.rows + 3 * k) * loadFloats(p + 4 * B.node[k]);
    const float change = sum(even + odd);
    c[row] = B.weights ? B.weights[row] * change : change;
  }
}

double apply(const PcgBlocks& K, const PcgVolumes& B, int begin, int end, const float* c,
             const PcgVectors& v) {
  Quad curvature{};
  for (int i = begin; i < end; ++i) {
    Floats y = multiplyRow(K, K.row_start[i], K.row_start[i + 1], v.p_single);
    if (c) {
      Floats even{}, odd{};
      int k = B.column_start[i];
      for (; k + 1 < B.column_start[i + 1]; k += 2) {
        even += loadFloats(B.columns + 3 * k) * c[B.pressure[k]];
        odd += loadFloats(B.columns + 3 * k + 3) * c[B.pressure[k + 1]];
      }
      if (k < B.column_start[i + 1]) even += loadFloats(B.columns + 3 * k) * c[B.pressure[k]];
      y += even + odd;
    }
    const Quad Ap = toDouble(y) * kFirstThree;
    storeQuad(v.Ap + 4 * i, Ap);
    curvature += Ap * loadQuad(v.p + 4 * i);
  }
  return sum(curvature);
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
const PcgKernels kPcgKernels{volumes, apply, update, direct};

}  // namespace palpate::solver::PALPATE_ISA
