// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fem_body.h"
#include "palpate/solver/unit_costs.h"

namespace palpate::tissue {

/// What decides how dear a cycle is, counted on the body at rest. No time and no number of threads
/// is among them: the choice, and with it every bit, is the same on every machine.
struct CycleCounts {
  double poisson_ratio = 0.0;  ///< The largest of any solid at rest.
  solver::TetCounts tets;
  double blocks = 0.0;  ///< Of the stiffness, 3 x 3.
  double volume_entries = 0.0;
  int linear_iterations = 0;  ///< Of conjugate gradients against a push on the surface.
  double direct = 0.0;        ///< A solve of `implicit_direct` with its factor [s], by unit costs.
  double factor_flops = 0.0, factor_nonzeros = 0.0;  ///< Of the whole matrix.
  double sub_steps = 0.0;                            ///< Of `tled` in a cycle.
  /// `tled` takes the settings and the body.
  bool explicit_accepts = false;
  bool mass_damping = false;  ///< There is some; without it an explicit body rings for ever.
};

struct MethodChoice {
  std::string method;  ///< One of methodNames(), not "auto".
  std::string reason;  ///< A line with the estimates and what was ruled out.
};

/// The method with the cheapest cycle of those that solve for the same thing, by the unit costs of
/// solver/unit_costs.h. `implicit_pcg` unless another is clearly cheaper.
MethodChoice chooseMethod(const CycleCounts& counts);

/// At rest where the mesh is; leaves the body relaxed.
/// @throws std::invalid_argument for an integrator that is not known.
CycleCounts countCycle(FemBody* body);

}  // namespace palpate::tissue
