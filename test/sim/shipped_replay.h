// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "palpate/base/percentiles.h"
#include "palpate/formats/trajectory.h"
#include "palpate/io/replay.h"
#include "palpate/sim/simulator.h"
#include "support/source_folder.h"

namespace palpate::test {

/// A shipped scene driven by its shipped trajectory. Every cycle must converge, keep its elements
/// from turning inside out and have balanced forces; run times are printed.
class ShippedReplay {
 public:
  /// `trajectory`: where it is another scene's, which.
  explicit ShippedReplay(const std::string& name, const std::string& trajectory = "")
      : name_(trajectory.empty() ? name : trajectory),
        simulator_(scene::readScene(sourceFolder() + "/config/scenes/" + name + ".yaml")),
        trajectory_(formats::readTrajectory(file())),
        replay_(&simulator_, trajectory_, file()) {}
  ~ShippedReplay() {
    const Percentiles ms = percentiles(ms_);
    std::printf("%s: %zu rows, step p50 %.1f, p99 %.1f, max %.1f ms, least det F %.3f\n",
                name_.c_str(), ms_.size(), ms.p50, ms.p99, ms.max, least_jacobian_);
  }
  ShippedReplay(const ShippedReplay&) = delete;
  ShippedReplay& operator=(const ShippedReplay&) = delete;

  /// All rows up to `t` [s], that of `t` too; `look` at each of them. The last result.
  const sim::StepResult& to(
      double t, const std::function<void(const sim::StepResult&)>& look = [](const auto&) {}) {
    while (replay_.hasNext() && trajectory_.t[replay_.row()] < t + 1e-9) {
      const auto begin = std::chrono::steady_clock::now();
      last_ = &replay_.next();
      const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - begin;
      ms_.push_back(ms.count());
      check(*last_);
      look(*last_);
    }
    return *last_;
  }

  const sim::Simulator& simulator() const { return simulator_; }
  int organ(const std::string& name) const {
    for (int i = 0; i < simulator_.numOrgans(); ++i) {
      if (simulator_.organName(i) == name) return i;
    }
    throw std::invalid_argument("no organ " + name);
  }

 private:
  std::string file() const { return sourceFolder() + "/config/trajectories/" + name_ + ".csv"; }
  // Newton's method leaves a force of at most the tolerance at each node. Friction beyond Coulomb's
  // cone, which is taken off what is reported, is up to 1e-4 of normal forces (docs/theory.md).
  void check(const sim::StepResult& result) {
    const double t = trajectory_.t[replay_.row() - 1];
    EXPECT_TRUE(result.report.ok()) << solver::toString(result.report.status) << " at " << t;
    EXPECT_GT(result.report.min_jacobian, 0.0) << t;
    least_jacobian_ = std::min(least_jacobian_, result.report.min_jacobian);
    double pressed = 0.0;
    for (const sim::ContactPoint& contact : result.contacts) pressed += contact.force_W.norm();
    EXPECT_LE(
        result.report.imbalance,
        2.0 * std::sqrt(result.report.nodes) * result.report.tolerance + 1e-4 * pressed + 1e-9)
        << t;
  }

  std::string name_;
  sim::Simulator simulator_;
  formats::Trajectory trajectory_;
  io::Replay replay_;
  const sim::StepResult* last_ = nullptr;
  std::vector<double> ms_;
  double least_jacobian_ = 1.0;
};

}  // namespace palpate::test
