// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/formats/trajectory.h"
#include "palpate/io/csv_writer.h"
#include "palpate/sim/lockstep.h"

namespace palpate::io {

/// Drives a simulator through a trajectory, a row at a time, and writes what came out.
class Replay {
 public:
  /// Columns are as jointColumns() has them, whatever the instruments' inputs are when live.
  /// @throws InputError
  Replay(sim::Simulator* simulator, formats::Trajectory trajectory, const std::string& file,
         sim::Cycles cycles = sim::Cycles::kByTime);

  /// The simulator was restored to where the first row had left it: goes on with the second one.
  void resume();
  bool hasNext() const { return row_ < trajectory_.t.size(); }
  /// Steps to the next row's time.
  const sim::StepResult& next();
  std::size_t row() const { return row_; }  ///< Rows done.
  /// Simulated steps that the last row took.
  int parts() const { return lockstep_.parts(); }
  double fraction() const {
    return static_cast<double>(row_) / static_cast<double>(trajectory_.t.size());
  }

  /// Head of the output.
  std::vector<std::string> columns() const;
  /// The last step as a row; all but `step_ms`, its wall time, depends on the inputs alone.
  void writeRow(double step_ms, CsvWriter* csv) const;

  double peakForce() const { return peak_force_; }  ///< Of any instrument so far [N].
  /// Of the mesh, estimated, where that was; see StepFigures::mesh_error [N].
  double meshErrorAtPeak() const { return mesh_error_; }
  int mostContacts() const { return most_contacts_; }
  int failedSteps() const { return failed_steps_; }

 private:
  std::vector<sim::LinkPoses> posesOf(std::size_t row) const;

  sim::Simulator* simulator_;
  sim::Lockstep lockstep_;
  formats::Trajectory trajectory_;
  std::vector<std::vector<int>> joint_column_;  // of each joint of each instrument
  std::size_t row_ = 0;
  double peak_force_ = 0.0, mesh_error_ = 0.0;
  int most_contacts_ = 0, failed_steps_ = 0;
};

}  // namespace palpate::io
