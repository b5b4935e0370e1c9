// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/thread_pool.h"

#include <gtest/gtest.h>

#include <thread>
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

// As where the next mesh is made beside the cycles.
TEST(ThreadPool, ServesTwoThreadsAtOnceAndLoopsWithinLoops) {
  ThreadPool pool(2);
  const auto work = [&](std::vector<int>* visits) {
    for (int loop = 0; loop < 2000; ++loop) {
      pool.forRanges(visits->size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++(*visits)[i];
      });
    }
  };
  std::vector<int> here(300, 0), beside(300, 0);
  std::thread other([&] { work(&beside); });
  work(&here);
  other.join();
  for (int v : here) ASSERT_EQ(v, 2000);
  for (int v : beside) ASSERT_EQ(v, 2000);

  {
    const ThreadPool::Beside one(&pool), another(&pool), none(nullptr);
    work(&here);
    for (int v : here) ASSERT_EQ(v, 4000);
  }

  std::vector<int> inner(16 * 16, 0);
  pool.forRanges(16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      pool.forRanges(16, [&](std::size_t first, std::size_t last) {
        for (std::size_t j = first; j < last; ++j) ++inner[16 * i + j];
      });
    }
  });
  for (int v : inner) ASSERT_EQ(v, 1);
}

}  // namespace
}  // namespace palpate
