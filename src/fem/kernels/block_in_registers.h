// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: the nine numbers of a 3 x 3 block, column-major or row-major.

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace palpate::fem {
namespace {

#if defined(__AVX512F__)
struct Block {
  __m512d first;
  double last;
};
inline Block loadBlock(const double* p) { return {_mm512_loadu_pd(p), p[8]}; }
inline void storeBlock(const Block& A, double* p) {
  _mm512_storeu_pd(p, A.first);
  p[8] = A.last;
}
inline Block transposed(const Block& A) {
  return {_mm512_permutexvar_pd(_mm512_setr_epi64(0, 3, 6, 1, 4, 7, 2, 5), A.first), A.last};
}
inline Block operator+(const Block& A, const Block& B) {
  return {_mm512_add_pd(A.first, B.first), A.last + B.last};
}
inline Block operator*(double s, const Block& A) {
  return {_mm512_mul_pd(_mm512_set1_pd(s), A.first), s * A.last};
}
#else
struct Block {
  double v[9];
};
inline Block loadBlock(const double* p) {
  Block A;
  for (int c = 0; c < 9; ++c) A.v[c] = p[c];
  return A;
}
inline void storeBlock(const Block& A, double* p) {
  for (int c = 0; c < 9; ++c) p[c] = A.v[c];
}
inline Block transposed(const Block& A) {
  return {{A.v[0], A.v[3], A.v[6], A.v[1], A.v[4], A.v[7], A.v[2], A.v[5], A.v[8]}};
}
inline Block operator+(const Block& A, const Block& B) {
  Block C;
  for (int c = 0; c < 9; ++c) C.v[c] = A.v[c] + B.v[c];
  return C;
}
inline Block operator*(double s, const Block& A) {
  Block B;
  for (int c = 0; c < 9; ++c) B.v[c] = s * A.v[c];
  return B;
}
#endif

}  // namespace
}  // namespace palpate::fem
