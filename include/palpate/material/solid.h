// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "palpate/material/material.h"

namespace palpate::material {

/// A term of a Prony series: the part g of the distortional stress relaxes with time constant tau.
/// The law's constants are instantaneous; the fraction 1 - sum g_i remains after infinite time.
struct PronyTerm {
  double g = 0.0;    ///< In (0, 1).
  double tau = 0.0;  ///< [s], > 0.
};

/// Material of a part of a body.
struct Solid {
  Material law;
  double density = 1000.0;  ///< [kg/m^3]
  std::vector<PronyTerm> prony;
};

/// Error of a Prony series: `name` is "g", "tau", "sum of g" or "law".
class PronyError : public ConstantError {
 public:
  PronyError(const std::string& constant, const std::string& given, const std::string& rule)
      : ConstantError(constant, given, rule) {}
  /// For a law without relaxation.
  PronyError(const std::string& law, const std::string& rule)
      : ConstantError("law " + law + " " + rule, "law", law, rule) {}

  std::optional<std::size_t> term;  ///< Index of the wrong term; empty: the whole series.
};

/// @throws PronyError for a g not in (0, 1), a tau not > 0, sum of g not < 1, or a law that is not
/// frame indifferent.
void checkProny(const Material& law, const std::vector<PronyTerm>& prony);

}  // namespace palpate::material
