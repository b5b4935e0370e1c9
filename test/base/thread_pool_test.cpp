// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace palpate::thread_pool_test {
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

TEST(ThreadPool, RunsTasksInAThreadThatTakesNoPartInLoops) {
  ThreadPool pool(1, true);
  EXPECT_EQ(pool.size(), 1);
  const std::thread::id caller = std::this_thread::get_id();
  std::thread::id of_task;
  std::atomic<bool> done{false};
  ThreadPool::BackgroundTask task(&pool);
  task.begin([&] {
    of_task = std::this_thread::get_id();
    done = true;
  });
  while (!done) std::this_thread::yield();  // without a thread for tasks, for ever
  pool.forRanges(100, [&](std::size_t begin, std::size_t end) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(end - begin, 100u);
  });
  task.wait();
  EXPECT_NE(of_task, caller);
}

// As background tasks that make meshes during the cycles: more tasks than helpers, with loops of
// their own.
TEST(ThreadPool, DoesTasksBesideLoops) {
  for (const int threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    ThreadPool::BackgroundTask one(&pool), another(&pool), third(&pool), alone(nullptr);
    for (int round = 0; round < 300; ++round) {
      std::vector<int> visits(200, 0), besides(4 * 200, 0);
      const auto loop = [&](int* counts) {
        pool.forRanges(200, [=](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) ++counts[i];
        });
      };
      one.begin([&] { loop(besides.data()); });
      another.begin([&] { loop(besides.data() + 200); });
      if (round % 2 == 0) third.begin([&] { loop(besides.data() + 400); });
      alone.begin([&] { loop(besides.data() + 600); });
      EXPECT_TRUE(one.underWay());
      for (int k = 0; k < 5; ++k) loop(visits.data());
      another.wait();
      one.wait();
      third.wait();
      alone.wait();
      EXPECT_FALSE(one.underWay());
      for (int v : visits) ASSERT_EQ(v, 5);
      for (std::size_t i = 0; i < besides.size(); ++i) {
        ASSERT_EQ(besides[i], round % 2 == 1 && i / 200 == 2 ? 0 : 1);
      }
    }
  }
}

// Before who gives it up goes on, or never.
TEST(ThreadPool, DoesNothingMoreOfATaskThatIsGivenUp) {
  for (const int threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    for (int round = 0; round < 300; ++round) {
      int by_the_dying = 0, by_the_living = 0;
      ThreadPool::BackgroundTask living(&pool);
      {
        ThreadPool::BackgroundTask dying(&pool);
        dying.begin([&] { ++by_the_dying; });
        living.begin([&] { ++by_the_living; });
        living.cancel();
        EXPECT_FALSE(living.underWay());
      }
      const int dead = by_the_dying, given_up = by_the_living;
      EXPECT_LE(dead + given_up, threads == 1 ? 0 : 2);
      living.begin([&] { by_the_living += 10; });
      pool.forRanges(100, [](std::size_t, std::size_t) {});
      living.wait();
      EXPECT_EQ(by_the_dying, dead);
      EXPECT_EQ(by_the_living, given_up + 10);
    }
  }
}

}  // namespace
}  // namespace palpate::thread_pool_test
