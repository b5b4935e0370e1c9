// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace palpate::instrument {

/// Selects the positions of wanted joints from named positions in any order (a JointState, a line
/// of a trajectory).
class JointMapper {
 public:
  /// Result of map(); bad input at run time is a status, not an exception.
  struct Status {
    std::string problem;  ///< A sentence; empty on success.

    bool ok() const { return problem.empty(); }
  };

  /// @param wanted names of the joints, in the order of the result.
  explicit JointMapper(std::vector<std::string> wanted);

  /// Sets (*q)[i] to the position of wanted joint i [m or rad]. Fails without change of `q` if a
  /// wanted joint is missing, repeated or not finite, or if `n` differs from the number of names.
  /// Does not allocate for the same `names` as last time.
  Status map(const std::vector<std::string>& names, const double* positions, std::size_t n,
             Eigen::VectorXd* q);

 private:
  Status find(const std::vector<std::string>& names);

  std::vector<std::string> wanted_;
  std::vector<std::string> names_;   // names that source_ is for; empty: none yet
  std::vector<std::size_t> source_;  // index of wanted joint i in names_
};

}  // namespace palpate::instrument
