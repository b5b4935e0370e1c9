// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/solver/unit_costs.h"
#include "tissue/body/fem_body.h"

namespace palpate::tissue {

/// Operation counts that decide the cost of a cycle, of the body at rest. Without times or thread
/// counts, so the choice is the same on every machine.
struct CycleCounts {
  double poisson_ratio = 0.0;  ///< Largest Poisson ratio of any solid at rest [-].
  solver::TetCounts tets;
  double blocks = 0.0;  ///< Number of 3 x 3 blocks of the stiffness.
  double volume_entries = 0.0;
  int linear_iterations = 0;  ///< Iterations of conjugate gradients for a surface load.
  double direct = 0.0;        ///< Estimated time of a solve of `implicit_direct` [s].
  double factor_flops = 0.0,
         factor_nonzeros = 0.0;  ///< Operations and entries of the factor of the whole matrix.
  double sub_steps = 0.0;        ///< Sub-steps of `tled` in a cycle.
  /// Whether `tled` supports settings and body.
  bool explicit_accepts = false;
  bool mass_damping = false;  ///< Whether explicit vibrations decay by mass damping.
};

struct MethodChoice {
  std::string method;  ///< One of methodNames(), not "auto".
  std::string reason;  ///< Estimates and excluded methods, in a line.
};

/// Chooses the cheapest of the equivalent methods by solver/unit_costs.h; `implicit_pcg` unless
/// another is clearly cheaper.
MethodChoice chooseMethod(const CycleCounts& counts);

/// Counts in the rest configuration; leaves the body relaxed.
/// @throws std::invalid_argument for an integrator that is not known.
CycleCounts countCycle(FemBody* body);

}  // namespace palpate::tissue
