// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
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

/// A Prony series that no solid can have: `name` is "g", "tau", "sum of g" or "law".
class PronyError : public ConstantError {
 public:
  PronyError(const std::string& constant, const std::string& given, const std::string& rule)
      : ConstantError(constant, given, rule) {}
  /// For a law that cannot relax.
  PronyError(const std::string& law, const std::string& rule)
      : ConstantError("law " + law + " " + rule, "law", law, rule) {}

  std::optional<std::size_t> term;  ///< Which one is to blame; none: the series as a whole.
};

/// @throws PronyError for a g not in (0, 1), a tau not > 0, sum of g not < 1, or a law that is not
/// frame indifferent and so cannot relax in large rotations.
void checkProny(const Material& law, const std::vector<PronyTerm>& prony);

}  // namespace palpate::material
