// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/guard/crash.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "ros/guard/ending.h"

namespace palpate::node::crash_test {
namespace {

volatile int deep = 0;

int fallWithoutEnd(int k) {
  volatile char room[1000];
  room[0] = static_cast<char>(k);
  deep = deep + room[0];
  return k < 0 ? 0 : fallWithoutEnd(k + 1) + room[0];
}

/// A program in which a thread does this; says so if the main thread goes on after it crashed.
template <class Body>
void crashIn(const Body& body) {
  Ending::watch();
  Crash::catchAll();
  std::thread(body).detach();
  while (Crash::signal() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::fputs("the others go on\n", stderr);
  Crash::end();
}

class CrashDeathTest : public ::testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers catch these signals themselves";
#endif
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  }
};

TEST_F(CrashDeathTest, TheOthersGoOnAfterARecursionWithoutEnd) {
  const auto body = [] {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);  // as a thread of ROS
    Crash::catchHere();
    fallWithoutEnd(0);
  };
  EXPECT_EXIT(crashIn(body), ::testing::KilledBySignal(SIGSEGV), "the others go on");
}

TEST_F(CrashDeathTest, AThreadOfOursHasAStackForIt) {
  const auto body = [] { Ending::guard("step", [] { fallWithoutEnd(0); }); };
  EXPECT_EXIT(crashIn(body), ::testing::KilledBySignal(SIGSEGV), "the others go on");
}

TEST_F(CrashDeathTest, TheOthersGoOnAfterAnExceptionThatNobodyCatches) {
  const auto body = [] { throw std::runtime_error("nobody catches this"); };
  EXPECT_EXIT(crashIn(body), ::testing::KilledBySignal(SIGABRT), "the others go on");
}

TEST_F(CrashDeathTest, IsTheEndWhereTheOthersCannotDoWithoutTheThread) {
  const auto body = [] {
    Crash::isFatalHere();
    std::raise(SIGSEGV);
  };
  EXPECT_EXIT(crashIn(body), ::testing::KilledBySignal(SIGSEGV), "^$");
}

TEST_F(CrashDeathTest, ASecondOneIsTheEnd) {
  const auto body = [] {
    std::thread([] { std::raise(SIGFPE); }).detach();
    while (Crash::signal() == 0) std::this_thread::yield();
    std::raise(SIGILL);
  };
  EXPECT_EXIT(crashIn(body), ::testing::KilledBySignal(SIGILL), "^$");
}

TEST_F(CrashDeathTest, EndsInTimeThoughTheOthersHang) {
  const auto hang = [] {
    Ending::watch();
    Crash::catchAll();
    std::thread([] { std::raise(SIGBUS); }).detach();
    for (;;) ::pause();
  };
  EXPECT_EXIT(hang(), ::testing::KilledBySignal(SIGBUS), "something hangs");
  const auto limited = [] {
    Ending::watch();
    Ending::limit(100.0, 8);
    Ending::limit(0.05, 7);
    Ending::limit(50.0, 9);
    for (;;) ::pause();
  };
  EXPECT_EXIT(limited(), ::testing::ExitedWithCode(7), "something hangs");
}

}  // namespace
}  // namespace palpate::node::crash_test
