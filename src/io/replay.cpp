// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/replay.h"

#include <algorithm>

#include "palpate/io/joint_columns.h"
#include "palpate/io/replay_table.h"

namespace palpate::io {

Replay::Replay(sim::Simulator* simulator, formats::Trajectory trajectory, const std::string& file,
               sim::Cycles cycles)
    : simulator_(simulator), lockstep_(simulator, cycles), trajectory_(std::move(trajectory)) {
  std::vector<InstrumentJoints> instruments;
  instruments.reserve(static_cast<std::size_t>(simulator->numInstruments()));
  for (int i = 0; i < simulator->numInstruments(); ++i) {
    instruments.push_back(
        {simulator->scene().instruments[i].name, simulator->instrument(i).jointNames()});
  }
  joint_column_ = jointColumns(trajectory_, instruments, file);
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
