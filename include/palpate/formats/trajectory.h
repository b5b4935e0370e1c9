// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace palpate::formats {

/// Joint positions over time.
///
/// As a file: comma-separated values; first row `t` and the names of the joints; then a row a time
/// [s] with positions [m or rad]; times increase. Lines that begin with # and empty ones are
/// skipped; blanks around values do not count.
struct Trajectory {
  std::vector<std::string> columns;  ///< Names without `t`, all different.
  std::vector<double> t;             ///< [s], strictly increasing.
  Eigen::MatrixXd values;            ///< columns x times [m or rad], finite.
};

/// @throws InputError naming the lines that are wrong: no or a wrong first row, a value that is no
/// finite number, a row of another length, time that does not increase, no rows.
Trajectory readTrajectory(const std::string& file);

}  // namespace palpate::formats
