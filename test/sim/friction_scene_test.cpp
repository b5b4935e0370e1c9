// SPDX-License-Identifier: GPL-3.0-or-later
// Friction as scenes have it: between whom, remembered, counted, and without memory from the heap.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "palpate/sim/simulator.h"
#include "slab_scene.h"
#include "support/allocations.h"
#include "support/contains.h"
#include "support/input_error.h"

namespace palpate::sim {
namespace {

constexpr double kStep = 0.01;

// The probe pressed into the slab and dragged aside.
struct Outcome {
  double aside = 0.0;  // the largest force along x that holds the probe back [N]
  std::int64_t contacts = 0, frictionless = 0;
  Points positions;
};

Outcome run(const scene::Scene& scene) {
  Simulator simulator(scene);
  Outcome out;
  for (const Eigen::VectorXd& q : test::SlabScene::press()) {
    const StepResult& result = simulator.step({simulator.linkPoses(0, q)}, kStep);
    EXPECT_TRUE(result.report.ok());
    out.aside = std::max(out.aside, -result.instruments[0].spatial.force.x());
    out.contacts += result.report.contacts;
    out.frictionless += result.report.skipped.frictionless_touches;
  }
  out.positions = simulator.positions(0);
  return out;
}

std::string contact(const std::string& friction) {
  return "contact: {friction: {" + friction + "}}\n";
}

TEST(FrictionOfScenes, IsOfTheMostSpecificPair) {
  const test::SlabScene slab;
  const Outcome none = run(slab.scene()), all = run(slab.scene(contact("static: 0.5")));
  EXPECT_GT(all.aside, none.aside + 0.05);
  EXPECT_EQ(none.frictionless, none.contacts);
  EXPECT_LT(all.frictionless, all.contacts / 20);
  // Of the whole instrument there is none, of its tip there is.
  const Outcome tip = run(slab.scene(contact(
      "pairs: [{instrument: probe, link: tip, static: 0.5}, {instrument: probe, static: 0}]")));
  EXPECT_EQ(tip.positions, all.positions);
  const Outcome not_tip = run(slab.scene(
      contact("static: 0.5, pairs: [{organ: slab, instrument: probe, link: tip, static: 0}]")));
  EXPECT_NEAR(not_tip.aside, none.aside, 0.01);
  const Outcome later = run(
      slab.scene(contact("pairs: [{organ: slab, static: 0}, {instrument: probe, static: 0.5}]")));
  EXPECT_EQ(later.positions, all.positions);
}

TEST(FrictionOfScenes, KnowsTheLinksThatTouch) {
  const test::SlabScene slab;
  const std::string said = test::complaint([&] {
    Simulator(slab.scene(contact("pairs: [{instrument: probe, link: handle, static: 1}]")));
  });
  EXPECT_TRUE(test::contains(said, "contact.friction.pairs[0].link"));
  EXPECT_TRUE(test::contains(said, "tip"));
  const std::string refused = test::complaint([&] {
    Simulator(slab.scene(contact("static: 0.5") + "solver: {method: newton_bicgstab}\n"));
  });
  EXPECT_TRUE(test::contains(refused, "contact.friction"));
}

TEST(FrictionOfScenes, GoesOnFromAStateToTheSameBitsWithAnyThreads) {
  const test::SlabScene slab;
  scene::Scene scene = slab.scene(contact("static: 0.6, kinetic: 0.4, teeth: 2.0e3"));
  Simulator one(scene);
  scene.solver.threads = 2;
  Simulator two(scene);
  const std::vector<Eigen::VectorXd> press = test::SlabScene::press();
  for (std::size_t k = 0; k < press.size(); ++k) {
    if (k == 70) two.restore(one.state());
    const Wrench a = one.step({one.linkPoses(0, press[k])}, kStep).instruments[0].spatial;
    if (k < 70) continue;
    const Wrench b = two.step({two.linkPoses(0, press[k])}, kStep).instruments[0].spatial;
    ASSERT_EQ(a.force, b.force) << k;
  }
  EXPECT_EQ(one.positions(0), two.positions(0));
}

TEST(FrictionOfScenes, NeedsNoMemoryInACycleOnceItHasSeenOneLikeIt) {
  const test::SlabScene slab;
  Simulator simulator(slab.scene(contact("static: 0.6, kinetic: 0.4, teeth: 2.0e3")));
  std::vector<std::vector<LinkPoses>> poses;
  for (const Eigen::VectorXd& q : test::SlabScene::press()) {
    poses.push_back({simulator.linkPoses(0, q)});
  }
  for (const bool counted : {false, true}) {
    simulator.reset();
    simulator.step(poses.front(), kStep);
    test::countAllocations(counted);
    for (const auto& pose : poses) simulator.step(pose, kStep);
    test::countAllocations(false);
  }
  EXPECT_EQ(test::allocations(), 0U);
}

}  // namespace
}  // namespace palpate::sim
