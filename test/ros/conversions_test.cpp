// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/messages/conversions.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <string>

namespace palpate::node::conversions_test {
namespace {

TEST(Conversions, AReportSaysInMillisecondsWhereTheTimeWent) {
  sim::StepReport report;
  for (std::size_t k = 0; k < kNumPhases; ++k) {
    report.phases[static_cast<Phase>(k)] = 1e-3 * static_cast<double>(k + 1);
  }
  const palpate::StepReport m = toMsg(report, NodeState::kRunning, ros::Time(1.0), 30.0);
  EXPECT_DOUBLE_EQ(m.contact_ms, 1.0);
  EXPECT_DOUBLE_EQ(m.forces_ms, 2.0);
  EXPECT_DOUBLE_EQ(m.assembly_ms, 3.0);
  EXPECT_DOUBLE_EQ(m.linear_solve_ms, 4.0);
  EXPECT_DOUBLE_EQ(m.line_search_ms, 5.0);
  EXPECT_DOUBLE_EQ(m.other_ms, 6.0);
  EXPECT_DOUBLE_EQ(m.haptics_ms, 7.0);
  EXPECT_DOUBLE_EQ(m.publish_ms, 8.0);
  EXPECT_EQ(m.cycle_ms, 30.0);
}

// Each figure gets a number of its own, which is looked for in the message as text.
TEST(Conversions, AReportHasEveryFigureOfTheTable) {
  sim::StepReport report;
  int number = 10;
  for (const auto& figure : sim::reportFigures()) {
    if (const auto* whole = std::get_if<int sim::StepReport::*>(&figure.value)) {
      report.** whole = ++number;
    } else if (const auto* real = std::get_if<double sim::StepReport::*>(&figure.value)) {
      report.** real = ++number;
    } else if (const auto* bits = std::get_if<std::uint64_t sim::StepReport::*>(&figure.value)) {
      report.** bits = static_cast<std::uint64_t>(++number);
    }
  }
  std::ostringstream text;
  text << toMsg(report, NodeState::kRunning, ros::Time(1.0), 30.0);
  number = 10;
  for (const auto& figure : sim::reportFigures()) {
    if (std::holds_alternative<solver::SolveStatus sim::StepReport::*>(figure.value)) continue;
    ++number;
    if (!figure.message) continue;
    const std::string line = std::string(figure.name) + ": " + std::to_string(number) + "\n";
    EXPECT_NE(text.str().find(line), std::string::npos) << line << text.str();
  }
}

TEST(Conversions, NoMessageHoldsANumberThatIsNotFinite) {
  sim::StepReport report;
  report.residual = std::numeric_limits<double>::quiet_NaN();
  report.imbalance = std::numeric_limits<double>::infinity();
  const palpate::StepReport m = toMsg(report, NodeState::kFault, ros::Time(1.0), 1.0);
  EXPECT_EQ(m.residual, -1.0);
  EXPECT_EQ(m.imbalance, -1.0);
  EXPECT_EQ(m.state, "FAULT");
}

}  // namespace
}  // namespace palpate::node::conversions_test
