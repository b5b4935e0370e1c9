// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/fem/energy_term.h"

namespace palpate::tissue {

/// Loads on a body other than gravity and contact, and prescribed motion of held nodes.
struct Drive {
  std::vector<const fem::EnergyTerm*> loads;  ///< @pre Outlive the body.
  double load_norm = 0.0;  ///< Norm of the loads' nodal forces, for tolerances [N].
  /// Positions of held components at fraction s in [0, 1] of the cycle, 3 x n [m]; free components
  /// are ignored. Empty: held components do not move.
  std::function<Points(double s)> held;
};

}  // namespace palpate::tissue
