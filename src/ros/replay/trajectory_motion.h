// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "motion.h"
#include "palpate/formats/trajectory.h"
#include "palpate/instrument/instrument.h"

namespace palpate::node {

/// A table of joint positions, as `palpate replay` takes it, at regular times: positions between
/// two rows lie on the line between them. An instrument whose input is tf is published by the poses
/// that these joints give its links, each below the world.
class TrajectoryMotion : public Motion {
 public:
  /// `period` [s] of the motion lies between two pieces. The publishers must live as long.
  /// @throws InputError
  TrajectoryMotion(const std::string& file, const scene::Scene& scene, double period,
                   InputPublishers* publishers);

  void rewind() override { tick_ = 0; }
  std::optional<double> next() override;
  void send(double t, const PlayedTime& played) override;

 private:
  struct Tool {
    instrument::Instrument instrument;
    scene::InstrumentConfig config;
    std::vector<int> columns;  // of the joints
  };

  double timeOf(std::size_t tick) const;
  Eigen::VectorXd valuesAt(double t) const;
  Eigen::VectorXd jointsOf(const Tool& tool, const Eigen::VectorXd& values) const;

  formats::Trajectory trajectory_;
  double period_;
  InputPublishers& publishers_;
  std::vector<Tool> tools_;
  std::size_t ticks_;  // of the motion, the last row's included
  std::size_t tick_ = 0;
};

}  // namespace palpate::node
