// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/material/constants.h"

namespace palpate::material {

/// `names` and the alternatives of the bulk modulus: kappa, poisson_ratio.
std::vector<std::string> withBulkModulus(std::vector<std::string> names);

/// Reads the own constants of a law and its bulk modulus, given as kappa [Pa] or by the Poisson
/// ratio at rest. Numbers must be finite. All functions throw ConstantError.
class OwnConstants {
 public:
  /// @pre `constants` outlives this. @throws std::invalid_argument unless all of `needed` and one
  /// of kappa and poisson_ratio are given.
  OwnConstants(const Constants& constants, const std::vector<std::string>& needed);
  OwnConstants(Constants&&, const std::vector<std::string>&) = delete;

  double number(const std::string& name) const;
  double positive(const std::string& name) const;     ///< > 0
  double notNegative(const std::string& name) const;  ///< >= 0
  /// number(name), or `default_value` if missing.
  double numberOr(const std::string& name, double default_value) const;

  /// Non-empty lists of equal length, one per name.
  std::vector<std::vector<double>> listsOfEqualLength(const std::vector<std::string>& names) const;

  /// kappa, > 0, or 2 mu (1 + nu) / (3 (1 - 2 nu)) with nu = poisson_ratio in (-1, 0.5) [Pa].
  double bulkModulus(double mu) const;

 private:
  const Constants& constants_;
};

/// Checks a value derived from several constants: `what` is a name or a formula, `allowed`
/// completes "must be ...". @throws ConstantError unless `right`.
void require(bool right, const std::string& what, double value, const std::string& allowed);

}  // namespace palpate::material
