// SPDX-License-Identifier: GPL-3.0-or-later
// The force between two solves against the same scene solved every millisecond.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "palpate/haptics/tool_renderer.h"
#include "slab_scene.h"

namespace palpate::sim::between_solves_test {
namespace {

constexpr int kCycle = 10, kSolve = 5;  // of the simulation, and from its input to its wrench [ms]
constexpr double kTouch = -0.055;       // joint z where the ball touches

using Motion = std::function<Vec3(double t)>;  // joints x, y, z

struct Case {
  std::string name;
  Motion at;
  double duration;
};

std::vector<Case> cases() {
  const auto eased = [](double s) { return 0.5 - 0.5 * std::cos(M_PI * std::clamp(s, 0.0, 1.0)); };
  return {
      {"press", [=](double t) { return Vec3(0, 0, kTouch + 0.002 - 0.01 * eased(t / 0.3)); }, 0.8},
      {"tremor",
       [](double t) {
         const double wave = std::sin(2.0 * M_PI * 4.0 * std::max(0.0, t - 0.3));
         return Vec3(0, 0, kTouch - 0.005 * std::min(1.0, t / 0.3) + 0.002 * wave);
       },
       1.3},
      {"slide",
       [=](double t) {
         return Vec3(0.02 * eased((t - 0.3) / 0.5), 0, kTouch - 0.005 * std::min(1.0, t / 0.3));
       },
       1.0},
      {"taps",
       [](double t) { return Vec3(0, 0, kTouch + 0.004 + 0.008 * std::cos(4.0 * M_PI * t)); }, 1.0},
  };
}

double rms(const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::size_t late) {
  double sum = 0.0;
  for (std::size_t k = late; k < a.size(); ++k) sum += (a[k] - b[k - late]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size() - late));
}

class BetweenSolves : public ::testing::TestWithParam<Case> {
 protected:
  BetweenSolves() : scene(slab.scene("gravity: [0, 0, 0]\ncontact: {stiffness: 3.0e8}\n")) {}

  LinkPoses poses(const Simulator& simulator, int ms) const {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q.head<3>() = GetParam().at(1e-3 * ms);
    return simulator.linkPoses(0, q);
  }
  /// Solved every `cycle` [ms].
  std::vector<Wrench> solved(int cycle) const {
    Simulator simulator(scene);
    std::vector<Wrench> wrenches;
    for (int ms = 0; 1e-3 * ms <= GetParam().duration; ms += cycle) {
      wrenches.push_back(
          simulator.step({poses(simulator, ms)}, 1e-3 * cycle).instruments[0].spatial);
    }
    return wrenches;
  }

  test::SlabScene slab;
  scene::Scene scene;
};

// Bounds are those asked for: 3 % of the peak, 2 ms late.
TEST_P(BetweenSolves, TheLocalModelIsTheForceOfSolvesEachMillisecond) {
  std::vector<Vec3> exact, local, held;
  Vec3 last = Vec3::Zero();
  for (const Wrench& wrench : solved(1)) exact.push_back(wrench.force);
  const std::vector<Wrench> coarse = solved(kCycle);
  haptics::ToolRenderer tool({}, {}, 1e-3);
  haptics::VelocityEstimate velocity;
  haptics::RenderedContact solving, contact;
  for (int ms = 0; ms < static_cast<int>(exact.size()); ++ms) {
    const Vec3 p = GetParam().at(1e-3 * ms);  // the base is not turned
    velocity.update(p, 1e-3);
    if (ms % kCycle == 0) {
      const Wrench& wrench = coarse[static_cast<std::size_t>(ms / kCycle)];
      solving = tool.observe(p, p, wrench, 1e-3 * kCycle).contact;
    }
    if (ms % kCycle == kSolve) {
      contact = solving;
      last = coarse[static_cast<std::size_t>(ms / kCycle)].force;
    }
    // What is sent now is there in a tick, for a tick.
    local.push_back(contact.at(p, velocity.velocity()).force);
    held.push_back(last);
  }
  for (std::vector<Vec3>* sent : {&local, &held}) {
    sent->insert(sent->begin(), Vec3::Zero());
    sent->pop_back();
  }
  for (std::size_t k = 0; k + 1 < exact.size(); ++k) exact[k] = 0.5 * (exact[k] + exact[k + 1]);
  double peak = 0.0;
  for (const Vec3& force : exact) peak = std::max(peak, force.norm());
  std::size_t delay = 0;
  for (std::size_t late = 1; late < 25; ++late) {
    if (rms(local, exact, late) < rms(local, exact, delay)) delay = late;
  }
  EXPECT_GT(peak, 0.1);
  EXPECT_LT(rms(local, exact, 0), 0.03 * peak);

  EXPECT_LE(delay, 2U);
  EXPECT_LT(rms(local, exact, 0), rms(held, exact, 0));
  RecordProperty("delay_ms", static_cast<int>(delay));
  RecordProperty("rms_percent", std::to_string(100.0 * rms(local, exact, 0) / peak));
  RecordProperty("held_percent", std::to_string(100.0 * rms(held, exact, 0) / peak));
}

INSTANTIATE_TEST_SUITE_P(Motions, BetweenSolves, ::testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace palpate::sim::between_solves_test
