// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/material/constants.h"

namespace palpate::material {

/// The names a law's constants have, and those that say its bulk modulus: kappa, poisson_ratio.
std::vector<std::string> withBulkModulus(std::vector<std::string> names);

/// Reads the constants of a law that has its own, and beside them the bulk modulus, which is given
/// either as kappa [Pa] or by the Poisson ratio that the law has at rest. Each number must be
/// finite. Every function throws ConstantError.
class OwnConstants {
 public:
  /// @throws std::invalid_argument unless all of `needed` are given, and either kappa or
  /// poisson_ratio. Keeps a reference to `constants`.
  OwnConstants(const Constants& constants, const std::vector<std::string>& needed);
  OwnConstants(Constants&&, const std::vector<std::string>&) = delete;

  double number(const std::string& name) const;
  double positive(const std::string& name) const;     ///< > 0
  double notNegative(const std::string& name) const;  ///< >= 0
  /// number(name), or the default where it is not given.
  double numberOr(const std::string& name, double default_value) const;

  /// Lists of one or more, one in each place of `names`, all of one length.
  std::vector<std::vector<double>> listsOfEqualLength(const std::vector<std::string>& names) const;

  /// kappa, > 0, or 2 mu (1 + nu) / (3 (1 - 2 nu)) with nu = poisson_ratio in (-1, 0.5) [Pa].
  double bulkModulus(double mu) const;

 private:
  const Constants& constants_;
};

/// For what follows from several constants: `what` is a name or a formula, `allowed` completes
/// "must be ...".
/// @throws ConstantError unless `right`.
void require(bool right, const std::string& what, double value, const std::string& allowed);

}  // namespace palpate::material
