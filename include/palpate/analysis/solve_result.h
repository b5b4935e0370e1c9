// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::analysis {

/// What a probe measured; a point has displacement and stress, a reaction force and moment.
struct ProbeResult {
  std::string name;
  std::optional<Vec3> displacement;                          ///< [m]
  std::optional<Eigen::Matrix<double, 6, 1>> cauchy_stress;  ///< xx yy zz xy yz zx [Pa]
  std::optional<double> von_mises;                           ///< Of it [Pa].
  std::optional<Vec3> principal_stretches;                   ///< Largest first.
  std::optional<Vec3> force;                                 ///< [N]
  std::optional<Vec3> moment;                                ///< About the origin [N m].
};

/// Summary of a run of `palpate solve`.
struct SolveResult {
  std::string status;          ///< toString(SolveStatus).
  double load_factor = 1.0;    ///< What part of the loads of a static case it converged for.
  int load_steps = 0;          ///< Done; time steps in a dynamic case.
  int rejected_steps = 0;      ///< Tried again in shorter ones.
  int newton_iterations = 0;   ///< Of all steps.
  double residual = 0.0;       ///< Relative, of the last step.
  double strain_energy = 0.0;  ///< Viscous: potential of the last step [J].
  std::vector<std::pair<std::string, double>> energy_by_region;  ///< [J], where there are regions.
  double min_jacobian = 1.0;                                     ///< Smallest det F of any element.
  std::vector<std::pair<std::string, double>> seconds;  ///< Wall time by part, with "total".
  std::vector<ProbeResult> probes;
};

}  // namespace palpate::analysis
