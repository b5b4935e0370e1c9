// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/environment.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace palpate::start::environment_test {
namespace {

long pageFaults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

// Some 16 MiB in blocks of different sizes, as a body on a new mesh takes, and given back.
void takeAndFree() {
  std::vector<std::vector<char>> blocks;
  for (int k = 0; k < 16; ++k) blocks.emplace_back((k % 4 == 0 ? 3 << 20 : 1 << 18), '\1');
}

TEST(Environment, FreedMemoryIsKept) {
  if (dlsym(RTLD_DEFAULT, "__sanitizer_get_allocated_size") != nullptr) {
    GTEST_SKIP() << "needs the allocator of the C library; sanitizers bring their own";
  }
  keepFreedMemory();
  takeAndFree();
  const long before = pageFaults();
  for (int k = 0; k < 10; ++k) takeAndFree();
  EXPECT_LT(pageFaults() - before, 100);  // each time anew it would be 3800 pages
}

TEST(Environment, ALargeWriteFailsAndEndsNothing) {
  const auto write = [](bool lets_fail) {
    if (lets_fail) letLargeWritesFail();
    const rlimit limit{1, 1};  // [bytes]
    std::FILE* file = std::tmpfile();
    if (!file || setrlimit(RLIMIT_FSIZE, &limit) != 0) std::exit(3);
    std::exit(::write(fileno(file), "ab", 2) == 1 && ::write(fileno(file), "c", 1) == -1 &&
                      errno == EFBIG
                  ? 0
                  : 2);
  };
  EXPECT_EXIT(write(false), ::testing::KilledBySignal(SIGXFSZ), "");
  EXPECT_EXIT(write(true), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace palpate::start::environment_test
