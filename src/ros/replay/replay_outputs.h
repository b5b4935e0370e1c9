// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <rosbag/bag.h>

#include <memory>
#include <string>
#include <vector>

#include "bag_inputs.h"
#include "palpate/RunRecord.h"
#include "palpate/base/atomic_file.h"
#include "palpate/io/csv_writer.h"
#include "palpate/sim/simulator.h"

namespace palpate::node {

/// The output bag: wrenches in both frames and reports with the stamp of the cycle, and a copy of
/// the input messages. Record times are stamps and all wall times are 0, so that the same input
/// gives the same messages.
class ReplayBag {
 public:
  /// @throws InputError if the file cannot be written.
  ReplayBag(const std::string& file, const scene::Scene& scene);
  /// These, too.
  void copy(const rosbag::MessageInstance& message, const ros::Time& stamp);
  void write(const ros::Time& stamp, const sim::StepResult& result);
  /// What the results are of, as the node says it.
  void write(const palpate::RunRecord& record);
  void finish();

 private:
  /// A bag that cannot be closed, on a full disk, throws in its own destructor, too: it is left.
  struct Close {
    void operator()(rosbag::Bag* bag) const;
  };
  template <class Action>
  void writing(const Action& action);

  std::string name_;
  AtomicFile file_;
  const scene::Scene& scene_;
  std::unique_ptr<rosbag::Bag, Close> bag_;
};

/// The joints of the cycles as `palpate replay` reads them: t [s] and one column a joint.
class TrajectoryCsv {
 public:
  /// @throws InputError if it cannot be written or an instrument comes by tf.
  TrajectoryCsv(const std::string& file, const sim::Simulator& simulator);
  /// @throws InputError if time goes back, which a trajectory cannot. The same time again, which
  /// makes no step, is left out.
  void write(double t, const std::vector<Eigen::VectorXd>& joints);
  void finish();

 private:
  std::string file_;
  AtomicFile part_;
  std::unique_ptr<io::CsvWriter> csv_;
  bool begun_ = false;
  double last_ = 0.0;
};

/// The wrenches and reports as `palpate replay` writes them.
class ResultCsv {
 public:
  /// @throws InputError if it cannot be written.
  ResultCsv(const std::string& file, const scene::Scene& scene);
  void write(double t, const sim::StepResult& result, double step_ms);
  void finish();

 private:
  AtomicFile part_;
  io::CsvWriter csv_;
};

}  // namespace palpate::node
