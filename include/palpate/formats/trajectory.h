// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace palpate::formats {

/// Joint positions over time.
///
/// As a file: comma-separated values. The first row is `t` and the joint names; each further row a
/// time [s], increasing, and positions [m or rad]. Empty lines, lines beginning with # and blanks
/// around values are ignored.
struct Trajectory {
  std::vector<std::string> columns;  ///< Names without `t`, unique.
  std::vector<double> t;             ///< [s], strictly increasing.
  Eigen::MatrixXd values;            ///< columns x times [m or rad], finite.
};

/// @throws InputError naming the wrong lines: a missing or wrong first row, a value that is not a
/// finite number, a row of another length, non-increasing time, no rows.
Trajectory readTrajectory(const std::string& file);

}  // namespace palpate::formats
