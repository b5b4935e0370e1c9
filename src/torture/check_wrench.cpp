// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include "box.h"
#include "checks.h"
#include "palpate/haptics/wrench_filter.h"

namespace palpate::torture {
namespace {

constexpr double kTick = 1e-3;              // step of the force loop [s]
constexpr double kRoundingOfLimits = 1e-9;  // relative rounding error of limits

// Relative stretch from which tissue on a tool counts as carried, not touched.
constexpr double kCarried = 1.0;

class Hand {
 public:
  explicit Hand(const haptics::WrenchFilterSettings& limits) : limits_(limits), filter_(limits) {}

  // Runs the force loop for the time in which this wrench is the newest.
  std::string feel(const sim::InstrumentResult& tool, double dt) {
    const int ticks = std::clamp(static_cast<int>(std::lround(dt / kTick)), 1, 100);
    for (int k = 0; k < ticks; ++k) {
      const Wrench before = filter_.output(), now = filter_.update(tool.solved, tool.live, kTick);
      if (!now.allFinite()) return "the hand's wrench is not finite";
      const double rate = (now.force - before.force).norm() / kTick;
      if (now.force.norm() > (1.0 + kRoundingOfLimits) * limits_.max_force) {
        return said("the hand feels", now.force.norm(), "N");
      }
      if (rate > (1.0 + 1e-6) * limits_.max_force_rate) return said("the hand feels", rate, "N/s");
      if (now.torque.norm() > (1.0 + kRoundingOfLimits) * limits_.max_torque) {
        return said("the hand feels", now.torque.norm(), "N m");
      }
    }
    return "";
  }

 private:
  haptics::WrenchFilterSettings limits_;
  haptics::WrenchFilter filter_;
};

class Wrenches : public Criterion {
 public:
  Wrenches(const TortureScene& scene, const sim::Simulator& simulator) : scene_(scene) {
    haptics::WrenchFilterSettings limits;
    limits.max_force = simulator.scene().haptics.max_force;
    limits.max_torque = simulator.scene().haptics.max_torque;
    limits.max_force_rate = simulator.scene().haptics.max_force_rate;
    limits.ramp = simulator.scene().rates.ramp;
    for (std::size_t k = 0; k < scene.tools.size(); ++k) hands_.emplace_back(limits);
    for (int i = 0; i < simulator.numOrgans(); ++i) {
      const Points& x = simulator.positions(i);
      rest_.push_back({x.rowwise().minCoeff(), x.rowwise().maxCoeff()});
    }
  }

  std::string check(const Cycle& cycle) override {
    gone_ = cycle.row >= scene_.leave ? gone_ + cycle.dt : 0.0;
    for (std::size_t i = 0; i < hands_.size(); ++i) {
      const sim::InstrumentResult& tool = cycle.result.instruments[i];
      std::string wrong = hands_[i].feel(tool, cycle.dt);
      if (wrong.empty() && tool.live) wrong = wrongForce(cycle, i);
      if (wrong.empty() && gone_ > cycle.simulator.scene().rates.ramp + 2.0 * cycle.dt &&
          tool.spatial.force.norm() > 0.0) {
        wrong = said("a tool that is gone feels", tool.spatial.force.norm(), "N");
      }
      if (!wrong.empty()) return wrong;
    }
    return "";
  }

 private:
  std::string wrongForce(const Cycle& cycle, std::size_t i) const {
    const sim::InstrumentResult& tool = cycle.result.instruments[i];
    const double force = tool.solved.force.norm();
    if (force == 0.0) return "";
    if (tool.contacts == 0) return said("touches nothing and feels", force, "N");
    if (scene_.organs.front().held && !scene_.bone) {
      double away = 1e300;
      for (const Box& box : rest_) {
        away = std::min(away, box.distance(tool.X_WC.translation()) - scene_.tools[i].radius());
      }
      if (away > kCarried * scene_.size()) {
        return said("feels", force, "N") +
               said(" of tissue that it carries along,", 1e3 * away, "mm away");
      }
    }
    return "";
  }

  const TortureScene& scene_;
  std::vector<Hand> hands_;
  std::vector<Box> rest_;
  double gone_ = 0.0;
};

}  // namespace

std::unique_ptr<Criterion> checkWrench(const TortureScene& scene, const sim::Simulator& simulator) {
  return std::make_unique<Wrenches>(scene, simulator);
}

}  // namespace palpate::torture
