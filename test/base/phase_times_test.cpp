// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/phase_times.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <string>
#include <thread>

namespace palpate::phase_times_test {
namespace {

TEST(PhaseTimes, EveryPhaseHasANameOfItsOwn) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < kNumPhases; ++k) {
    names.insert(std::string(toString(static_cast<Phase>(k))));
  }
  EXPECT_EQ(names.size(), kNumPhases);
  EXPECT_EQ(names.count("unknown"), 0u);
  EXPECT_EQ(toString(static_cast<Phase>(kNumPhases)), "unknown");
}

TEST(PhaseTimes, ACycleIsWhatTheSimulationDoes) {
  PhaseTimes a, b;
  a[Phase::kContact] = 1.0;
  a[Phase::kHaptics] = 10.0;
  b[Phase::kContact] = 2.0;
  b[Phase::kOther] = 4.0;
  b[Phase::kPublish] = 20.0;
  a += b;
  EXPECT_EQ(a[Phase::kContact], 3.0);
  EXPECT_EQ(a[Phase::kPublish], 20.0);
  EXPECT_EQ(a.cycle(), 7.0);
}

TEST(PhaseTimer, AddsTheTimeOfItsLife) {
  PhaseTimes times;
  const double begin = steadySeconds();
  for (int k = 0; k < 2; ++k) {
    const PhaseTimer timer(&times, Phase::kAssembly);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const double end = steadySeconds();
  EXPECT_GE(times[Phase::kAssembly], 0.004);
  EXPECT_LE(times[Phase::kAssembly], end - begin);
  EXPECT_EQ(times.cycle(), times[Phase::kAssembly]);
  const PhaseTimer nothing(nullptr, Phase::kContact);
}

}  // namespace
}  // namespace palpate::phase_times_test
