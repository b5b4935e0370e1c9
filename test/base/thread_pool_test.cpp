// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/thread_pool.h"

#include <gtest/gtest.h>

#include <vector>

namespace palpate {
namespace {

TEST(ThreadPool, VisitsEachIndexOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.size(), threads);
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{5}, std::size_t{1000}}) {
      std::vector<int> visits(count, 0);
      for (int loop = 0; loop < 50; ++loop) {
        pool.forRanges(count, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
      }
      for (int v : visits) ASSERT_EQ(v, 50);
    }
  }
}

}  // namespace
}  // namespace palpate
