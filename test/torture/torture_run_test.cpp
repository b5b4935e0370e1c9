// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/torture_run.h"

#include <gtest/gtest.h>

#include "palpate/torture/draw.h"
#include "support/temp_folder.h"

namespace palpate::torture::torture_run_test {
namespace {

// Its organ hangs, and would collapse standing, which is how it is to begin.
TEST(Run, RefusesAStartThatIsNone) {
  const TortureScene scene = drawScene(1, 7068);
  ASSERT_EQ(scene.start, Start::kTurnedGravity);
  const test::TempFolder folder;
  const Outcome outcome = run(scene, folder.path(""), RunLimits());
  EXPECT_NE(outcome.refused.find("no equilibrium under gravity"), std::string::npos);
  EXPECT_EQ(outcome.refused.find(folder.path("")), std::string::npos);
}

}  // namespace
}  // namespace palpate::torture::torture_run_test
