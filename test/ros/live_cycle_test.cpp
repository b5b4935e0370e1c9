// SPDX-License-Identifier: GPL-3.0-or-later
// Steps that end later than their cycle's deadline are the same steps.
#include "ros/node/live_cycle.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "palpate/sim/lockstep.h"
#include "sim/slab_scene.h"

namespace palpate::node::live_cycle_test {
namespace {

/// A hand that the test moves.
class Hand final : public Input {
 public:
  bool poll(InputSample* sample) override {
    if (silent) return false;
    sample->valid = true;
    sample->stamp = ros::Time(1.0);
    sample->received = Steady::now();
    sample->poses = poses;
    return true;
  }
  void forget() override {}
  std::string source() const override { return "the test"; }
  std::string problem() const override { return ""; }

  sim::LinkPoses poses;
  bool silent = false;
};

/// A live cycle without ROS, of a slab and a hand that goes on when a step has ended.
class Bench {
 public:
  explicit Bench(const std::string& deadline, const std::string& haptics = "",
                 const std::string& organ = "")
      : scene_(scene::readScene(
            slab_.file("solver: {deadline: " + deadline + "}\n" + haptics, organ))),
        simulator_(scene_) {
    auto hand = std::make_unique<Hand>();
    hand_ = hand.get();
    inputs_.push_back(std::move(hand));
    cycle_ = std::make_unique<LiveCycle>(&simulator_, &inputs_, &channels_);
  }

  /// Cycles until a step with the hand there has ended, and returns its report.
  sim::StepReport step(const Eigen::VectorXd& joints) {
    hand_->poses = simulator_.linkPoses(0, joints);
    for (const long before = cycle_->cycles(); cycle_->cycles() == before;) {
      cycle_->run();
      late_ += cycle_->cycles() == before;
    }
    return channels_.report.read().report;
  }
  void run() { cycle_->run(); }
  LiveCycle& cycle() { return *cycle_; }
  Hand& hand() { return *hand_; }
  HapticTarget told() { return channels_.haptic[0].read(); }
  double force() { return told().render.contact.model.wrench.force.norm(); }
  double coarsening() { return channels_.statistics.read().coarsening; }
  NodeState state() { return channels_.report.read().state; }
  int late() const { return late_; }

 private:
  const test::SlabScene slab_;
  const scene::Scene scene_;
  sim::Simulator simulator_;
  Inputs inputs_;
  Hand* hand_;
  Channels channels_{1};
  std::unique_ptr<LiveCycle> cycle_;
  int late_ = 0;
};

constexpr char kWaits[] = "0", kNeverWaits[] = "1.0e-9";

class LiveCycleTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { ros::Time::init(); }
  const std::vector<Eigen::VectorXd> press_ = test::SlabScene::press();
};

TEST_F(LiveCycleTest, DoesNotCutStepsShort) {
  Bench waits(kWaits), hurries(kNeverWaits);
  double peak = 0.0;
  for (const Eigen::VectorXd& joints : press_) {
    const sim::StepReport expected = waits.step(joints), report = hurries.step(joints);
    ASSERT_TRUE(report.ok()) << solver::toString(report.status);
    ASSERT_EQ(report.residual, expected.residual);
    ASSERT_EQ(report.elastic_energy, expected.elastic_energy);
    ASSERT_EQ(hurries.force(), waits.force());
    peak = std::max(peak, waits.force());
  }
  EXPECT_GT(peak, 0.1);
  EXPECT_EQ(waits.late(), 0);
  EXPECT_GT(hurries.late(), 150);
}

// Also where the tissue is too stiff for a slow force loop, and the tool goes less deep than the
// hand.
TEST_F(LiveCycleTest, HasTheBitsOfALockstepOfLiveCycles) {
  for (const std::string haptics : {"", "rates: {haptic: 50}\n"}) {
    const test::SlabScene slab;
    const scene::Scene scene = slab.scene(haptics);
    sim::Simulator simulator(scene), plain(scene);
    sim::Lockstep lockstep(&simulator, sim::Cycles::kLive);
    Bench bench(kWaits, haptics);
    int apart = 0;
    double time = 0.0;
    for (const Eigen::VectorXd& joints : press_) {
      const std::uint64_t hash = bench.step(joints).state_hash;
      const std::vector<sim::LinkPoses> poses = {simulator.linkPoses(0, joints)};
      ASSERT_EQ(lockstep.advance(time += 0.0137, poses).report.state_hash, hash);
      apart += plain.step(poses, scene.solver.step).report.state_hash != hash;
    }
    if (haptics.empty()) {
      EXPECT_EQ(apart, 0);
    } else {
      EXPECT_GT(apart, 50);
    }
  }
}

// All touching cycles are late at 10 kHz. A mesh that never changes is not said to be coarser.
TEST_F(LiveCycleTest, CoarsensMeshesThatAdaptAndNoOthers) {
  const std::string rates = "rates: {simulation: 10000}\n";
  for (const bool adapts : {false, true}) {
    Bench bench(kWaits, rates, adapts ? "    adapt: {finest: 0.004}\n" : "");
    for (const Eigen::VectorXd& joints : press_) bench.step(joints);
    std::this_thread::sleep_for(std::chrono::seconds(1));  // statistics come once a second
    bench.run();
    EXPECT_EQ(bench.coarsening() > 1.0, adapts);
  }
}

TEST_F(LiveCycleTest, HoldsTheForceWhileAStepIsLate) {
  Bench bench(kNeverWaits);
  for (int k = 0; k <= 60; ++k) bench.step(press_[static_cast<std::size_t>(k)]);
  HapticTarget before;
  for (long cycles = -1, tries = 0; cycles != bench.cycle().cycles(); ++tries) {
    ASSERT_LT(tries, 100);
    before = bench.told();
    ASSERT_TRUE(before.render.live);
    cycles = bench.cycle().cycles();
    bench.run();  // the next step is under way, or was faster than this thread
  }
  EXPECT_TRUE(bench.told().render.live);
  EXPECT_EQ(bench.told().made, before.made);  // who waits too long lets go
  EXPECT_EQ(bench.force(), before.render.contact.model.wrench.force.norm());
}

TEST_F(LiveCycleTest, ResetsWithAStepUnderWay) {
  Bench fresh(kWaits), bench(kNeverWaits);
  for (int k = 0; k <= 60; ++k) bench.step(press_[static_cast<std::size_t>(k)]);
  bench.run();
  bench.cycle().abandonStep();
  bench.cycle().reset();
  for (int k = 0; k <= 60; ++k) {
    const Eigen::VectorXd& joints = press_[static_cast<std::size_t>(k)];
    ASSERT_EQ(bench.step(joints).elastic_energy, fresh.step(joints).elastic_energy) << k;
  }
}

TEST_F(LiveCycleTest, SavesTheStateAfterTheStepUnderWay) {
  Bench waits(kWaits), hurries(kNeverWaits);
  for (int k = 0; k <= 60; ++k) {
    const Eigen::VectorXd& joints = press_[static_cast<std::size_t>(k)];
    waits.step(joints);
    hurries.step(joints);
  }
  waits.step(press_[60]);
  hurries.run();
  EXPECT_EQ(hurries.cycle().state()->bytes(), waits.cycle().state()->bytes());
}

}  // namespace
}  // namespace palpate::node::live_cycle_test
