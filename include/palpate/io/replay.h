// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/formats/trajectory.h"
#include "palpate/io/csv_writer.h"
#include "palpate/sim/lockstep.h"

namespace palpate::io {

/// Steps a simulator through a trajectory row by row, and writes the results.
class Replay {
 public:
  /// Columns are as for jointColumns(), independent of the instruments' live inputs. @throws
  /// InputError
  Replay(sim::Simulator* simulator, formats::Trajectory trajectory, const std::string& file,
         sim::Cycles cycles = sim::Cycles::kByTime);

  /// Continues with the second row, after the simulator was restored to the state after the first.
  void resume();
  bool hasNext() const { return row_ < trajectory_.t.size(); }
  /// Steps to the time of the next row.
  const sim::StepResult& next();
  std::size_t row() const { return row_; }  ///< Number of completed rows.
  /// Number of simulation steps of the last row.
  int parts() const { return lockstep_.parts(); }
  double fraction() const {
    return static_cast<double>(row_) / static_cast<double>(trajectory_.t.size());
  }

  /// Header of the output.
  std::vector<std::string> columns() const;
  /// Writes the last step as a row; all but the wall time `step_ms` is reproducible.
  void writeRow(double step_ms, CsvWriter* csv) const;

  double peakForce() const { return peak_force_; }  ///< Over all instruments [N].
  /// Estimated mesh error at the largest force [N], see StepFigures::mesh_error.
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
