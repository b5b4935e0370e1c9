// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/material/material.h"

namespace palpate::material {

/// A term of a Prony series: of the distortional stress, the part g relaxes with time constant tau.
/// The law's constants are those of a sudden load; after long 1 - sum g_i of it is left.
struct PronyTerm {
  double g = 0.0;    ///< In (0, 1).
  double tau = 0.0;  ///< [s], > 0.
};

/// What a part of a body is made of.
struct Solid {
  Material law;
  double density = 1000.0;  ///< [kg/m^3]
  std::vector<PronyTerm> prony;
};

/// @throws std::invalid_argument for a g not in (0, 1), a tau not > 0, sum of g not < 1, or a law
/// that is not frame indifferent and so cannot relax in large rotations.
void checkProny(const Material& law, const std::vector<PronyTerm>& prony);

}  // namespace palpate::material
