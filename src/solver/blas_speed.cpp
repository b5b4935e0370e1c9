// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/blas_speed.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>
#include <vector>

#include "loaded_blas.h"
#include "palpate/base/phase_times.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace palpate::solver {
namespace {

constexpr int kSize = 256;      // of the matrices
constexpr int kRuns = 5;        // the fastest counts; the first wakes the library
constexpr int kSums = 12;       // independent sums hide the units' latency
constexpr int kTurns = 20'000;  // about 0.1 ms

#if defined(__x86_64__)
// One multiplication and addition per lane and sum in each turn. The result only prevents removal
// of the loop by the compiler.
__attribute__((target("avx512f"))) double multiplyAdd512(double start) {
  __m512d sums[kSums];
  for (__m512d& sum : sums) sum = _mm512_set1_pd(start);
  const __m512d a = _mm512_set1_pd(0.5), b = _mm512_set1_pd(start);
  for (int t = 0; t < kTurns; ++t) {
    for (__m512d& sum : sums) sum = _mm512_fmadd_pd(sum, a, b);
  }
  for (int k = 1; k < kSums; ++k) sums[0] = _mm512_add_pd(sums[0], sums[k]);
  double lanes[8];
  _mm512_storeu_pd(lanes, sums[0]);
  return lanes[0];
}

__attribute__((target("avx2,fma"))) double multiplyAdd256(double start) {
  __m256d sums[kSums];
  for (__m256d& sum : sums) sum = _mm256_set1_pd(start);
  const __m256d a = _mm256_set1_pd(0.5), b = _mm256_set1_pd(start);
  for (int t = 0; t < kTurns; ++t) {
    for (__m256d& sum : sums) sum = _mm256_fmadd_pd(sum, a, b);
  }
  for (int k = 1; k < kSums; ++k) sums[0] = _mm256_add_pd(sums[0], sums[k]);
  return _mm256_cvtsd_f64(sums[0]);
}

double multiplyAdd128(double start) {
  __m128d sums[kSums];
  for (__m128d& sum : sums) sum = _mm_set1_pd(start);
  const __m128d a = _mm_set1_pd(0.5), b = _mm_set1_pd(start);
  for (int t = 0; t < kTurns; ++t) {
    for (__m128d& sum : sums) sum = _mm_add_pd(_mm_mul_pd(sum, a), b);
  }
  for (int k = 1; k < kSums; ++k) sums[0] = _mm_add_pd(sums[0], sums[k]);
  return _mm_cvtsd_f64(sums[0]);
}
#endif

template <class Work>
double fastest(const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kRuns; ++k) {
    const double begin = steadySeconds();
    work();
    best = std::min(best, steadySeconds() - begin);
  }
  return best;
}

double measurePeak() {
#if defined(__x86_64__)
  int lanes = 2;
  double (*loop)(double) = multiplyAdd128;
  if (__builtin_cpu_supports("avx512f")) {
    lanes = 8;
    loop = multiplyAdd512;
  } else if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    lanes = 4;
    loop = multiplyAdd256;
  }
  volatile double start = 1e-3, sink = 0.0;
  const double seconds = fastest([&] { sink = loop(start); });
  return 2.0 * lanes * kSums * kTurns / seconds;
#else
  return 0.0;
#endif
}

double measureDgemm() {
  const auto dgemm = loadedBlas<Dgemm>("dgemm_");
  if (dgemm == nullptr) return 0.0;
  const int n = kSize;
  const double one = 1.0, zero = 0.0;
  const std::vector<double> A(n * n, 0.5), B(n * n, 0.25);
  std::vector<double> C(n * n, 0.0);
  const double seconds = fastest(
      [&] { dgemm("N", "N", &n, &n, &n, &one, A.data(), &n, B.data(), &n, &zero, C.data(), &n); });
  return 2.0 * n * n * n / seconds;
}

}  // namespace

BlasSpeed measureBlasSpeed() { return {measureDgemm(), measurePeak()}; }

std::string blasWarning(const BlasSpeed& speed, const char* coretype) {
  if (!speed.known() || speed.dgemm >= kSlowBlas * speed.peak) return "";
  std::ostringstream text;
  text << std::setprecision(3) << "BLAS multiplies matrices at " << speed.dgemm / 1e9 << " of "
       << speed.peak / 1e9 << " Gflop/s that this processor can do; factorisations are as slow. ";
  if (coretype == nullptr) {
    text << "Its library probably does not know the processor: with OpenBLAS set "
            "OPENBLAS_CORETYPE (SKYLAKEX with AVX-512, HASWELL with AVX2) before the program "
            "starts, or install libopenblas0-serial in place of the reference BLAS";
  } else {
    text << "OPENBLAS_CORETYPE is " << coretype
         << ": perhaps not what this processor is, perhaps the BLAS is not OpenBLAS (see "
            "update-alternatives), or other programs use the processor";
  }
  return text.str();
}

}  // namespace palpate::solver
