// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/node/pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace palpate::node::pace_test {
namespace {

struct Ran {
  double rate, age;  // cycles a second, median age of the newest input when they begin [ms]
};

// Cycles of 3 ms at 100 Hz for 30 s, of which the first ten do not count, with inputs at these
// times [s]. Each `disturbed` seconds a cycle takes 23.7 ms.
Ran run(const std::vector<double>& inputs, double interval, double disturbed = 1e3) {
  const double latency = 1e-4;  // of a thread that wakes
  const auto at = [](double t) { return Steady::time_point(seconds(t)); };
  const auto in = [](Steady::time_point t) { return inSeconds(t.time_since_epoch()); };
  Pace pace(seconds(0.01), at(0.0));
  std::size_t heard = 0;  // inputs so far
  std::vector<double> ages;
  int cycles = 0;
  double now = 0.0;
  const auto hear = [&](double until) {
    while (heard < inputs.size() && inputs[heard] <= until) ++heard;
  };
  while (now < 30.0) {
    const std::size_t known = heard;
    hear(now);
    const double last = heard > 0 ? inputs[heard - 1] : 0.0;
    const Pace::Plan plan = pace.next(at(last), seconds(heard > 2 ? interval : 0.0));
    const std::size_t old = plan.afresh ? heard : known;
    now = std::max(now, in(plan.from) + latency);
    hear(now);
    if (heard == old) {  // nothing yet
      const bool comes = heard < inputs.size() && inputs[heard] <= in(plan.until);
      now = std::max(now, (comes ? inputs[heard] : in(plan.until)) + latency);
      hear(now);
    }
    pace.began(at(now));
    if (now > 10.0) {
      ++cycles;
      if (heard > 0) ages.push_back(1e3 * (now - inputs[heard - 1]));
    }
    const bool disturbs = std::floor(now / disturbed) < std::floor((now + 0.01) / disturbed);
    now += disturbs ? 0.0237 : 0.003;
    pace.ended(at(now));
  }
  std::sort(ages.begin(), ages.end());
  return {cycles / 20.0, ages.empty() ? 0.0 : ages[ages.size() / 2]};
}

// With inputs each `interval` from `phase` on [s].
Ran run(double interval, double phase, double jitter = 0.0, double disturbed = 1e3) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shake(-jitter, jitter);
  std::vector<double> inputs;
  for (double t = phase; interval > 0.0 && t < 40.0; t += interval) {
    inputs.push_back(t + shake(random));
  }
  return run(inputs, interval, disturbed);
}

TEST(Pace, FallsIntoStepWithInputsThatComeAsOften) {
  for (const double phase : {0.001, 0.003, 0.005, 0.008}) {
    for (const double interval : {0.00999, 0.01, 0.01001, 0.0101}) {
      const Ran ran = run(interval, phase, 2e-4);
      EXPECT_LT(ran.age, 1.0) << phase << " " << interval;
      EXPECT_NEAR(ran.rate, std::min(1.0 / interval, 100.2), 0.5);
    }
  }
}

// Each long cycle costs two that are not made up for; in 1.5 s there are some 150.
TEST(Pace, FallsIntoStepAgainAfterCyclesThatTookTooLong) {
  for (const double phase : {0.001, 0.003, 0.005, 0.008}) {
    const Ran ran = run(0.01, phase, 2e-4, 1.5);
    EXPECT_LT(ran.age, 1.0) << phase;
    EXPECT_GT(ran.rate, 97.0) << phase;
    EXPECT_LT(ran.rate, 100.3) << phase;
  }
}

// One in five is late, by up to 6 ms; the next is not. 5 ms if one that came late were begun with
// when the next is due.
TEST(Pace, StaysInStepWhereSomeInputsAreLate) {
  for (const double phase : {0.001, 0.003, 0.005, 0.008}) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> late(0.0, 1.0);
    std::vector<double> inputs;
    for (int k = 0; k < 4000; ++k) {
      const double delay = late(random) < 0.2 ? 0.006 : 2e-4;
      inputs.push_back(phase + 0.01 * k + delay * late(random));
    }
    const Ran ran = run(inputs, 0.01);
    EXPECT_LT(ran.age, 2.0) << phase;
    EXPECT_NEAR(ran.rate, 100.0, 0.3) << phase;
  }
}

// A program that sleeps between what it sends: each sleep is a little too long, and one in twenty
// by up to 6 ms, after which all are later.
TEST(Pace, FallsIntoStepWithInputsOfWhoSleeps) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> late(0.0, 1.0);
    std::vector<double> inputs;
    for (double t = 0.003; t < 40.0; t += 0.0101 + 2e-4 * late(random)) {
      if (late(random) < 0.05) t += 0.006 * late(random);
      inputs.push_back(t);
    }
    const Ran ran = run(inputs, 0.01035);
    EXPECT_LT(ran.age, 1.0) << seed;
    EXPECT_GT(ran.rate, 96.0) << seed;
    EXPECT_LT(ran.rate, 100.3) << seed;
  }
}

TEST(Pace, IsWhatWasAskedWithInputsThatComeMoreOftenOrMoreSeldomOrNever) {
  for (const double interval : {0.001, 0.004, 0.007, 0.008, 0.013, 0.0333, 0.1, 0.0}) {
    const Ran ran = run(interval, 0.002, 1e-4);
    EXPECT_GT(ran.rate, 96.0) << interval;
    EXPECT_LT(ran.rate, 100.3) << interval;
  }
}

TEST(Pace, DoesNotMakeUpForCyclesThatTookTooLong) {
  Pace pace(seconds(0.01), Steady::time_point());
  pace.began(Steady::time_point(seconds(0.01)));
  pace.ended(Steady::time_point(seconds(0.055)));
  const Pace::Plan plan = pace.next(Steady::time_point(), seconds(0.0));
  EXPECT_EQ(plan.from, Steady::time_point(seconds(0.055)));
  EXPECT_EQ(plan.until, plan.from);
}

}  // namespace
}  // namespace palpate::node::pace_test
