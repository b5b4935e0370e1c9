// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped gallbladder full of bile: pressed, it resists by its pressure; it breathes meanwhile.
#include <gtest/gtest.h>

#include "palpate/sim/simulator.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "support/source_folder.h"

namespace palpate::sim::hollow_gallbladder_test {
namespace {

scene::Scene gallbladder() {
  return scene::readScene(test::sourceFolder() + "/config/scenes/gallbladder_full.yaml");
}

struct Pressed {
  double force = 0.0, pressure = 0.0, worst_imbalance = 0.0, least_pressure = 1e9;
  int contacts = 0;
};

// The ball of 5 mm, which is 0.1 m below the joints' zero, goes 6 mm into the fundus from above.
Pressed press(const scene::Scene& scene) {
  Simulator simulator(scene);
  Pressed pressed;
  for (int k = 0; k <= 80; ++k) {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q[0] = -0.015;
    q[2] = -0.106 - 0.010 * std::min(k / 50.0, 1.0);  // tip at 0.044 .. 0.034 m
    const StepResult& result = simulator.step({simulator.linkPoses(0, q)}, 0.01);
    EXPECT_TRUE(result.report.usable()) << k;
    pressed.contacts += result.report.contacts;
    pressed.force = std::max(pressed.force, result.instruments[0].spatial.force.norm());
    pressed.pressure = std::max(pressed.pressure, result.report.cavity_pressure);
    pressed.least_pressure = std::min(pressed.least_pressure, result.report.cavity_pressure);
    pressed.worst_imbalance = std::max(pressed.worst_imbalance, result.report.imbalance);
  }
  return pressed;
}

TEST(HollowGallbladder, ResistsByThePressureOfItsBile) {
  const scene::Scene full = gallbladder();
  scene::Scene empty = full;
  empty.organs[0].pressure.clear();
  const Pressed a = press(full), b = press(empty);
  std::printf("force %.3f N full, %.3f N empty; pressure %.0f to %.0f Pa; imbalance %.1e N\n",
              a.force, b.force, a.least_pressure, a.pressure, a.worst_imbalance);
  EXPECT_GT(a.contacts, 0);
  EXPECT_GT(a.pressure, 1100.0);
  EXPECT_GT(a.force, 1.05 * b.force);
  EXPECT_EQ(b.pressure, 0.0);
  EXPECT_LT(a.worst_imbalance, 0.01 * a.force);
}

TEST(HollowGallbladder, SaysWhatIsWrongWithItsPressure) {
  const auto errorOf = [](const std::function<void(scene::Scene*)>& change) {
    scene::Scene scene = gallbladder();
    change(&scene);
    return test::complaint([&] { Simulator simulator(scene); });
  };
  EXPECT_TRUE(test::contains(errorOf([](scene::Scene* s) { s->organs[0].pressure[0].cavity = 1; }),
                             "organs[0].pressure[0].cavity = 1: the organ's mesh has 1, counted "
                             "from 0"));
  EXPECT_TRUE(test::contains(errorOf([](scene::Scene* s) {
                               s->organs[0].surface = "../organs/gallbladder.obj";
                               s->organs[0].edge_length.coarsest = 0.006;
                             }),
                             "the organ's mesh has no cavity"));
  EXPECT_TRUE(test::contains(
      errorOf([](scene::Scene* s) {
        s->organs[0].pressure[0].cavity.reset();
        s->organs[0].pressure[0].select = mesh::BoxRegion{Vec3(-1.0, -1.0, 0.02), Vec3::Ones()};
      }),
      "organs[0].pressure[0].volume_stiffness: needs faces that enclose"));
}

}  // namespace
}  // namespace palpate::sim::hollow_gallbladder_test
