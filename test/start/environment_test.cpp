// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/environment.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

namespace palpate::start {
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
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "needs the allocator of the C library; sanitizers bring their own";
#endif
  keepFreedMemory();
  takeAndFree();
  const long before = pageFaults();
  for (int k = 0; k < 10; ++k) takeAndFree();
  EXPECT_LT(pageFaults() - before, 100);  // each time anew it would be 3800 pages
}

}  // namespace
}  // namespace palpate::start
