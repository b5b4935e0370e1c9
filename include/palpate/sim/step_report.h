// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/phase_times.h"
#include "palpate/base/types.h"
#include "palpate/solver/status.h"
#include "palpate/tissue/skips.h"

namespace palpate::sim {

/// What one cycle did. Sums over organs where several are in the scene, maxima where said.
struct StepReport {
  double time = 0.0;  ///< Simulated time at the end of the cycle [s].
  double step = 0.0;  ///< Its length [s].
  solver::SolveStatus status = solver::SolveStatus::kConverged;  ///< The worst organ's.
  int contacts = 0;              ///< Active contact samples, all instruments.
  double max_penetration = 0.0;  ///< [m]
  int sweep_stages = 1;          ///< Parts that the tool's motion was cut into; the largest.
  int time_steps = 1;            ///< That made it; more than one where longer ones failed.
  int newton_iterations = 0;
  int cg_iterations = 0;
  int factor_waits = 0;         ///< Waits for a factor made beside; depends on how fast that was.
  double residual = 0.0;        ///< Largest organ's Euclidean norm of unbalanced force [N].
  double tolerance = 0.0;       ///< What it was asked to be below [N].
  double imbalance = 0.0;       ///< |tool + support + gravity + inertia forces| [N], see docs.
  double min_jacobian = 1.0;    ///< Smallest det F of any element.
  double kinetic_energy = 0.0;  ///< [J]
  double elastic_energy = 0.0;  ///< Of viscous organs the potential of the last step [J].
  tissue::SkipCounters skipped;
  PhaseTimes phases;  ///< Wall time; the one part that differs between equal runs.

  bool ok() const { return status == solver::SolveStatus::kConverged; }
  /// The state at the end is one that the tissue really took, if not to full accuracy.
  bool usable() const { return solver::usable(status); }
};

}  // namespace palpate::sim
