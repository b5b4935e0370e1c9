// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace palpate::instrument {

/// Picks the positions of wanted joints out of named positions that come in any order and with
/// others among them (a JointState, a line of a trajectory).
class JointMapper {
 public:
  /// Bad input is an outcome, not an exception: it comes while running.
  struct Status {
    std::string problem;  ///< A sentence; empty if all is well.

    bool ok() const { return problem.empty(); }
  };

  /// @param wanted names of the joints, in the order of the result.
  explicit JointMapper(std::vector<std::string> wanted);

  /// (*q)[i] becomes the position of wanted joint i [m or rad]. Fails, and leaves `q` as it was, if
  /// a wanted joint is missing, given twice or not finite, or if there are not as many positions
  /// (`n`) as names. Does not allocate while `names` are the same as last time and all is well.
  Status map(const std::vector<std::string>& names, const double* positions, std::size_t n,
             Eigen::VectorXd* q);

 private:
  Status find(const std::vector<std::string>& names);

  std::vector<std::string> wanted_;
  std::vector<std::string> names_;   // that source_ is for; empty: none yet
  std::vector<std::size_t> source_;  // of wanted joint i, into names_
};

}  // namespace palpate::instrument
