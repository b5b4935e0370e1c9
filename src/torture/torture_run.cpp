// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/torture_run.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <sstream>

#include "learned_files.h"
#include "organ_cells.h"
#include "palpate/base/error.h"
#include "palpate/base/percentiles.h"
#include "palpate/base/phase_times.h"
#include "palpate/io/replay.h"
#include "palpate/io/state_file.h"
#include "palpate/solver/deadline.h"
#include "palpate/torture/criteria.h"
#include "palpate/torture/draw.h"

namespace palpate::torture {
namespace {

// Longest live cycle in deadlines: an iteration may be in progress, and one more follows.
constexpr double kTwice = 2.0;
constexpr double kPeriods = 2.0;  // default deadline of the node, in periods of a live loop

// Work of a cycle as text.
std::string effortOf(const sim::StepReport& report) {
  std::ostringstream out;
  out.precision(3);
  out << report.newton_iterations << " iterations in " << report.sweep_stages << " stages, "
      << report.time_steps << " steps in the last trial; [s]";
  for (std::size_t k = 0; k < kNumCyclePhases; ++k) {
    const auto phase = static_cast<Phase>(k);
    if (report.phases[phase] < 0.01 * report.phases.cycle()) continue;
    out << " " << toString(phase) << " " << report.phases[phase];
  }
  return out.str();
}

// Makes tables of different machines equal.
std::string without(const std::string& folder, std::string text) {
  for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at)) {
    text.erase(at, folder.size());
  }
  return text;
}

// Random cuts of cycles, by a pattern.
class Cuts {
 public:
  Cuts(const TortureScene& scene, int pattern)
      : draw_(scene.seed ^ (static_cast<std::uint64_t>(pattern) << 32),
              static_cast<std::uint64_t>(scene.number)),
        last_((scene.leave + scene.trajectory.t.size()) / 2) {}
  void begin(std::size_t row) {
    left_ = row < last_ ? draw_.whole(2 << draw_.whole(6)) : std::numeric_limits<int>::max();
  }
  bool isNow() { return left_-- <= 0; }

 private:
  Draw draw_;
  std::size_t last_;
  int left_ = 0;
};

class Run {
 public:
  Run(const TortureScene& scene, const std::string& folder, const RunLimits& limits)
      : scene_(scene), limits_(limits), folder_(folder), files_(writeScene(scene, folder)) {}

  Outcome go() {
    const double begin = steadySeconds();
    std::unique_ptr<sim::Simulator> simulator;
    try {
      writeLearned(scene_, files_.scene, folder_);
      scene::Scene read = scene::readScene(files_.scene);
      read.solver.threads = keepsTime() ? std::max(limits_.threads, 2) : limits_.threads;
      simulator = std::make_unique<sim::Simulator>(read);
    } catch (const std::exception& error) {
      outcome_.refused = without(folder_ + "/", error.what());
      return outcome_;
    }
    outcome_.load_s = steadySeconds() - begin;
    replay(simulator.get());
    outcome_.run_s = steadySeconds() - begin;
    outcome_.median_ms = 1e3 * quantile(touching_, 0.5);
    return outcome_;
  }

 private:
  // Whether cycles must keep time: live mesh adaptation works between them.
  bool keepsTime() const {
    const auto adapts = [](const TortureOrgan& organ) { return organ.adapt > 0.0; };
    return scene_.live && std::any_of(scene_.organs.begin(), scene_.organs.end(), adapts);
  }

  double liveSeconds() const { return std::max(limits_.live, kPeriods * scene_.step); }

  void fail(const std::string& criterion, std::size_t row, const std::string& what) {
    if (!what.empty() && !outcome_.fails(criterion))
      outcome_.failures.push_back({criterion, row, what});
  }

  void replay(sim::Simulator* simulator) {
    std::vector<NamedCriterion> all = criteria(scene_, *simulator);
    if (limits_.cuts > 0) {
      const auto isTime = [](const NamedCriterion& one) { return one.name == "time"; };
      all.erase(std::remove_if(all.begin(), all.end(), isTime), all.end());
    }
    io::Replay replay(simulator, scene_.trajectory, files_.trajectory);
    const double begin = steadySeconds();
    double end = begin;  // end of the row's time
    solver::Deadline deadline(liveSeconds());
    Cuts cuts(scene_, limits_.cuts);
    if (limits_.cuts > 0) {
      simulator->setInterrupt([&] { return cuts.isNow() || steadySeconds() > end; });
    } else if (scene_.live) {
      simulator->setInterrupt([&] { return deadline.isLate(steadySeconds()); });
    } else {
      simulator->setInterrupt([&] { return steadySeconds() > end; });
    }
    while (replay.hasNext()) {
      const std::size_t row = replay.row();
      const double dt =
          row == 0 ? scene_.step : scene_.trajectory.t[row] - scene_.trajectory.t[row - 1];
      // A row may consist of several cycles.
      const double cycles = std::max(1.0, std::ceil(dt / scene_.step - 1e-6));
      const double began = steadySeconds();
      end = began + limits_.cycle;
      deadline.begin(began, cycles);
      cuts.begin(row);
      const sim::StepResult& result = replay.next();
      const double took = steadySeconds() - began;
      deadline.end(began + took);
      judge({*simulator, result, row, dt, replay.parts()}, took, &all);
      if (row == 0 && scene_.start != Start::kRest && !placeStart(simulator, &all)) return;
      if (outcome_.fails("finite") || outcome_.fails("cycle")) break;
      if (keepsTime() && limits_.sleep_until) limits_.sleep_until(began + dt);
      if (steadySeconds() - begin > limits_.scene) {
        outcome_.whole = false;
        break;
      }
    }
    failLate();
    const std::size_t last = replay.row() - 1;
    for (NamedCriterion& one : all) {
      // A stopped run did not come to rest.
      if (replay.hasNext() && one.name == "rest") continue;
      fail(one.name, last, one.criterion->finish());
    }
  }

  // Returns false without such a state, for example if only an inverted equilibrium exists.
  bool placeStart(sim::Simulator* simulator, std::vector<NamedCriterion>* all) {
    try {
      writeStart(scene_, files_, simulator);
    } catch (const std::exception& error) {
      outcome_.refused = without(folder_ + "/", error.what());
      return false;
    }
    for (NamedCriterion& one : *all) one.criterion->placed(*simulator);
    return true;
  }

  void judge(const Cycle& cycle, double took, std::vector<NamedCriterion>* all) {
    const sim::StepReport& report = cycle.result.report;
    ++outcome_.cycles;
    outcome_.unsolved += !solver::balanced(report.status);
    outcome_.inverted += report.status == solver::SolveStatus::kInverted;
    outcome_.touching += report.contacts > 0;
    outcome_.curled += report.ok() && hasCurledCorners(cycle.simulator);
    outcome_.put_back += report.recovery >= static_cast<int>(tissue::Recovery::kPutBack);
    outcome_.points = report.nodes;
    outcome_.longest_ms = std::max(outcome_.longest_ms, 1e3 * took);
    if (report.contacts > 0) touching_.push_back(took);
    for (const sim::InstrumentResult& tool : cycle.result.instruments) {
      outcome_.peak_force = std::max(outcome_.peak_force, tool.spatial.force.norm());
    }
    outcome_.hashes.push_back(report.state_hash);
    for (NamedCriterion& one : *all) fail(one.name, cycle.row, one.criterion->check(cycle));
    if (took > limits_.cycle) fail("cycle", cycle.row, effortOf(report));
    const double of_one = took / std::max(cycle.parts, 1);
    if (!scene_.live || of_one <= kTwice * liveSeconds()) return;
    ++late_;
    if (of_one <= latest_) return;
    latest_ = of_one;
    latest_row_ = cycle.row;
    latest_effort_ = effortOf(report);
  }

  bool hasCurledCorners(const sim::Simulator& simulator) {
    for (int i = 0; i < simulator.numOrgans(); ++i) {
      const mesh::CellMesh& cells = cells_.of(simulator, i);
      if (areQuadraticTets(cells) && leastAtCorners(cells, simulator.positions(i)) <= 0.0) {
        return true;
      }
    }
    return false;
  }

  // Reports the number of late cycles, and the longest.
  void failLate() {
    if (late_ == 0) return;
    std::ostringstream what;
    what.precision(3);
    what << 1e3 * latest_ << " ms, " << late_ << " such: " << latest_effort_;
    fail("deadline", latest_row_, what.str());
  }

  const TortureScene& scene_;
  const RunLimits& limits_;
  std::string folder_;
  SceneFiles files_;
  OrganCells cells_;
  Outcome outcome_;
  std::vector<double> touching_;  // [s]
  int late_ = 0;                  // number of late rows
  double latest_ = 0.0;           // longest late cycle [s]
  std::size_t latest_row_ = 0;
  std::string latest_effort_;
};

}  // namespace

bool Outcome::fails(const std::string& criterion) const {
  return std::any_of(failures.begin(), failures.end(),
                     [&](const Failure& one) { return one.criterion == criterion; });
}

Outcome run(const TortureScene& scene, const std::string& folder, const RunLimits& limits) {
  return Run(scene, folder, limits).go();
}

}  // namespace palpate::torture
