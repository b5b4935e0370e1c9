// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/replay.h"

#include <algorithm>
#include <set>

#include "palpate/base/error.h"
#include "palpate/io/replay_table.h"

namespace palpate::io {
namespace {

constexpr std::size_t kMaxProblems = 20;  // more than anybody reads

std::string prefixOf(const sim::Simulator& simulator, int instrument) {
  return simulator.scene().instruments[instrument].name + "/";
}

}  // namespace

Replay::Replay(sim::Simulator* simulator, formats::Trajectory trajectory, const std::string& file,
               sim::Cycles cycles)
    : simulator_(simulator), lockstep_(simulator, cycles), trajectory_(std::move(trajectory)) {
  const std::vector<std::string>& columns = trajectory_.columns;
  std::vector<Problem> problems;
  std::vector<std::string> wanted;
  std::set<int> used;
  const bool several = simulator->numInstruments() > 1;
  for (int i = 0; i < simulator->numInstruments(); ++i) {
    joint_column_.emplace_back();
    for (const std::string& joint : simulator->instrument(i).jointNames()) {
      const std::string full = prefixOf(*simulator, i) + joint;
      auto it = std::find(columns.begin(), columns.end(), full);
      if (it == columns.end() && !several) it = std::find(columns.begin(), columns.end(), joint);
      wanted.push_back(several ? full : joint);
      if (it == columns.end()) {
        problems.push_back({wanted.back(), "", "this joint has no column"});
      } else {
        joint_column_.back().push_back(static_cast<int>(it - columns.begin()));
        used.insert(joint_column_.back().back());
      }
    }
  }
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (used.count(static_cast<int>(c))) continue;
    if (problems.size() >= kMaxProblems) break;
    const std::string nearest = nearestName(columns[c], wanted);
    problems.push_back({"column " + columns[c], "",
                        "is no joint of the scene" +
                            (nearest.empty() ? "" : " (did you mean " + nearest + "?)") +
                            "; it has " + joinNames(wanted)});
  }
  if (!problems.empty()) throw InputError(file, problems);
}

std::vector<sim::LinkPoses> Replay::posesOf(std::size_t row) const {
  std::vector<sim::LinkPoses> poses;
  for (int i = 0; i < simulator_->numInstruments(); ++i) {
    const std::vector<int>& column = joint_column_[i];
    Eigen::VectorXd q(column.size());
    for (std::size_t j = 0; j < column.size(); ++j) q[j] = trajectory_.values(column[j], row);
    poses.push_back(simulator_->linkPoses(i, q));
  }
  return poses;
}

void Replay::resume() {
  lockstep_.resume(trajectory_.t.front(), posesOf(0));
  row_ = 1;
}

const sim::StepResult& Replay::next() {
  const sim::StepResult& result = lockstep_.advance(trajectory_.t[row_], posesOf(row_));
  ++row_;
  for (const sim::InstrumentResult& tool : result.instruments) {
    if (tool.spatial.force.norm() <= peak_force_) continue;
    peak_force_ = tool.spatial.force.norm();
    mesh_error_ = result.report.mesh_error;
  }
  most_contacts_ = std::max(most_contacts_, result.report.contacts);
  failed_steps_ += !result.report.ok();
  return result;
}

std::vector<std::string> Replay::columns() const { return replayColumns(simulator_->scene()); }

void Replay::writeRow(double step_ms, CsvWriter* csv) const {
  writeReplayRow(trajectory_.t[row_ - 1], lockstep_.result(), step_ms, csv);
}

}  // namespace palpate::io
