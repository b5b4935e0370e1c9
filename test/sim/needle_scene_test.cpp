// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped scene of a needle: into the block, held, and out again.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "palpate/sim/simulator.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "support/source_folder.h"

namespace palpate::sim::needle_scene_test {
namespace {

scene::Scene block() {
  return scene::readScene(test::sourceFolder() + "/config/scenes/needle_insertion.yaml");
}

TEST(NeedleScene, ShowsIndentationCuttingAndFriction) {
  const scene::Scene scene = block();
  const scene::NeedleConfig& law = scene.instruments[0].needle;
  Simulator simulator(scene);
  double depth = -0.003, highest = 0.0, inside = 0.0, drawn = 0.0, worst_imbalance = 0.0;
  const auto goTo = [&](double next) {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(5);
    depth = next;
    q[2] = -0.07 - depth;  // the tip begins 0.1 m above the table, 0.07 m above the surface
    const StepResult& result = simulator.step({simulator.linkPoses(0, q)}, 0.01);
    EXPECT_TRUE(result.report.usable()) << depth;
    worst_imbalance = std::max(worst_imbalance, result.report.imbalance);
    return result.instruments[0].spatial.force.z();
  };
  for (; depth < 0.022; highest = std::max(highest, inside)) inside = goTo(depth + 2.5e-4);
  while (depth > 0.008) drawn = goTo(depth - 2.5e-4);
  while (depth > -0.01) goTo(depth - 5e-4);
  double left = 0.0;
  for (int k = 0; k < 10; ++k) left = goTo(depth);
  std::printf("puncture at %.3f N, %.3f N inside, %.3f N on the way out; imbalance %.1e N\n",
              highest, inside, drawn, worst_imbalance);
  EXPECT_GE(highest, law.puncture_force);
  EXPECT_LT(highest, 1.2 * law.puncture_force);
  EXPECT_GT(inside, law.cutting_force);
  EXPECT_LT(inside, law.cutting_force + law.shaft_friction * 0.022 + 0.05);
  EXPECT_LT(drawn, -0.01);
  EXPECT_GT(drawn, -law.shaft_friction * 0.022);
  EXPECT_EQ(left, 0.0);
  EXPECT_LT(worst_imbalance, 0.01);
}

TEST(NeedleScene, SaysWhatIsWrongWithANeedle) {
  const auto errorOf = [](const std::function<void(scene::Scene*)>& change) {
    scene::Scene scene = block();
    change(&scene);
    return test::complaint([&] { Simulator simulator(scene); });
  };
  EXPECT_TRUE(
      test::contains(errorOf([](scene::Scene* s) { s->instruments[0].needle.link = "hub"; }),
                     "instruments[0].needle.link"));
  EXPECT_TRUE(test::contains(
      errorOf([](scene::Scene* s) { s->instruments[0].needle.puncture_force = 0.0; }),
      "instruments[0].needle.puncture_force"));
  EXPECT_TRUE(test::contains(errorOf([](scene::Scene* s) { s->solver.method = "tled"; }),
                             "knows no needle that goes in"));
}

}  // namespace
}  // namespace palpate::sim::needle_scene_test
