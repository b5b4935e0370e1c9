// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::analysis {

/// Values of a probe: displacement and stress of a point, or a reaction's force and moment.
struct ProbeResult {
  std::string name;
  std::optional<Vec3> displacement;                          ///< [m]
  std::optional<Eigen::Matrix<double, 6, 1>> cauchy_stress;  ///< xx yy zz xy yz zx [Pa]
  std::optional<double> von_mises;                           ///< Of cauchy_stress [Pa].
  std::optional<Vec3> principal_stretches;                   ///< Largest first.
  std::optional<Vec3> force;                                 ///< [N]
  std::optional<Vec3> moment;                                ///< About the origin [N m].
};

/// Summary of a run of `palpate solve`.
struct SolveResult {
  std::string status;          ///< toString(SolveStatus).
  double load_factor = 1.0;    ///< Fraction of a static case's loads that converged.
  int load_steps = 0;          ///< Completed steps; time steps of a dynamic case.
  int rejected_steps = 0;      ///< Steps repeated with a smaller size.
  int newton_iterations = 0;   ///< Sum over all steps.
  double residual = 0.0;       ///< Relative, of the last step.
  double strain_energy = 0.0;  ///< Viscous: potential of the last step [J].
  std::vector<std::pair<std::string, double>> energy_by_region;  ///< [J], if there are regions.
  double min_jacobian = 1.0;                                     ///< Least det F of all elements.
  std::vector<std::pair<std::string, double>> seconds;  ///< Wall time per part, with "total" [s].
  std::vector<ProbeResult> probes;
};

}  // namespace palpate::analysis
