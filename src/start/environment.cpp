// SPDX-License-Identifier: GPL-3.0-or-later
#include "environment.h"

#include <malloc.h>
#include <stdlib.h>  // setenv: POSIX
#include <unistd.h>

#include <csignal>

namespace palpate::start {
namespace {

bool setIfAbsent(const char* name, const char* value) {
  return getenv(name) == nullptr && setenv(name, value, 0) == 0;
}

void setIfAbsent(const char* name, int parameter, int value) {
  if (getenv(name) == nullptr) mallopt(parameter, value);
}

bool isIntelWithAvx512() {
#if defined(__x86_64__)
  return __builtin_cpu_is("intel") && __builtin_cpu_supports("avx512f") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
#else
  return false;
#endif
}

}  // namespace

void restartWithSolverEnvironment(char** argv) {
  bool changed = setIfAbsent("OMP_THREAD_LIMIT", "1");
  changed |= setIfAbsent("OPENBLAS_NUM_THREADS", "1");
  if (isIntelWithAvx512()) changed |= setIfAbsent("OPENBLAS_CORETYPE", "SKYLAKEX");
  if (changed) execv("/proc/self/exe", argv);
}

void keepFreedMemory() {
  constexpr int kMiB = 1 << 20;
  setIfAbsent("MALLOC_MMAP_THRESHOLD_", M_MMAP_THRESHOLD, 32 * kMiB);  // the most there is
  setIfAbsent("MALLOC_TRIM_THRESHOLD_", M_TRIM_THRESHOLD, 256 * kMiB);
  setIfAbsent("MALLOC_TOP_PAD_", M_TOP_PAD, 4 * kMiB);
}

void letLargeWritesFail() { std::signal(SIGXFSZ, SIG_IGN); }

}  // namespace palpate::start
