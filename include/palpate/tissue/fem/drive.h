// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/fem/energy_term.h"

namespace palpate::tissue {

/// What acts on a body beside gravity and contact, and how its held nodes move.
struct Drive {
  std::vector<const fem::EnergyTerm*> loads;  ///< Outlive the body.
  double load_norm = 0.0;  ///< Of their nodal forces: what a residual is compared with [N].
  /// Where the held components are at part s in [0, 1] of the cycle under way, 3 x n [m]; free ones
  /// are not read. Empty: they stay where they are.
  std::function<Points(double s)> held;
};

}  // namespace palpate::tissue
