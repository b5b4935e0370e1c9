// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "case_model.h"
#include "palpate/analysis/case_solver.h"
#include "palpate/mesh/point_location.h"

namespace palpate::analysis {

/// Probes of a case, located in its mesh.
class CaseProbes {
 public:
  /// @throws InputError for a point outside the mesh, or a region without nodes.
  CaseProbes(const Case& problem, const CaseModel& model);

  /// Values at positions x; `support_force`: forces of the supports on the nodes, 3 x n [N].
  std::vector<ProbeResult> measure(const CaseModel& model, const Points& x,
                                   const Points& support_force) const;

  /// Header and a row of the history file.
  std::vector<std::string> columns() const;
  static std::vector<double> row(double t, const std::vector<ProbeResult>& results);

 private:
  struct Placed {
    Probe probe;
    std::optional<mesh::Location> at;  // for a point
    std::vector<int> nodes;            // for a region
  };
  std::vector<Placed> placed_;
};

}  // namespace palpate::analysis
