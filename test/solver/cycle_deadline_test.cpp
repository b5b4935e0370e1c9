// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/deadline.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace palpate::solver::cycle_deadline_test {
namespace {

constexpr double kSeconds = 0.02;
constexpr double kLook = 1e-4;  // between two questions [s]

// A cycle that goes on for `landing` after it has been asked to end, and needs `work` if it is not:
// how long it took.
double cycle(double work, double landing, double* now, Deadline* deadline) {
  const double begin = *now;
  deadline->begin(begin);
  double end = begin + work;
  while (*now < end) {
    *now += kLook;
    if (deadline->isLate(*now)) end = std::min(end, *now + landing);
    if (end < begin + work) break;
  }
  *now = end;
  deadline->end(*now);
  return *now - begin;
}

TEST(Deadline, LeavesTimeToLand) {
  Deadline deadline(kSeconds);
  double now = 5.0;
  for (int k = 0; k < 10; ++k) {
    const double took = cycle(1.0, 0.008, &now, &deadline);
    EXPECT_LT(took, kSeconds + 2.0 * kLook) << k;
    EXPECT_GT(took, k > 5 ? kSeconds - 0.002 : 0.0) << k;
  }
}

TEST(Deadline, LearnsFromACycleThatWentOnForLonger) {
  Deadline deadline(kSeconds);
  double now = 0.0;
  EXPECT_GT(cycle(1.0, 0.017, &now, &deadline), kSeconds);
  for (int k = 0; k < 5; ++k) {
    EXPECT_LT(cycle(1.0, 0.017, &now, &deadline), kSeconds + 2.0 * kLook) << k;
  }
}

TEST(Deadline, AsksAtOnceWhereThereIsNotTimeEnough) {
  Deadline deadline(kSeconds);
  double now = 0.0;
  cycle(1.0, 0.05, &now, &deadline);
  deadline.begin(now);
  EXPECT_TRUE(deadline.isLate(now));
}

// As on a mesh that was fine for a while.
TEST(Deadline, ForgetsSoonHowLongCyclesWere) {
  Deadline deadline(kSeconds);
  double now = 0.0;
  cycle(1.0, 10.0 * kSeconds, &now, &deadline);
  for (int k = 0; k < 5; ++k) cycle(0.004, 1e-3, &now, &deadline);
  EXPECT_NEAR(cycle(0.004, 1.0, &now, &deadline), 0.004, 1e-9);
}

TEST(Deadline, LeavesCyclesAloneThatAreInTime) {
  Deadline deadline(kSeconds);
  double now = 0.0;
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(cycle(0.009, 1.0, &now, &deadline), 0.009, 1e-9);
}

TEST(Deadline, GivesSeveralCyclesTheTimeOfAll) {
  Deadline deadline(kSeconds);
  deadline.begin(1.0, 4.0);
  EXPECT_FALSE(deadline.isLate(1.0 + 3.0 * kSeconds));
  EXPECT_TRUE(deadline.isLate(1.0 + 4.0 * kSeconds));
}

}  // namespace
}  // namespace palpate::solver::cycle_deadline_test
