// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace palpate::material {

/// Constants of a law as given by the user: names and numbers. A scalar is a list of one.
using Constants = std::map<std::string, std::vector<double>>;

/// Error of a constant, or of a formula of several constants, that the law does not allow.
class ConstantError : public std::invalid_argument {
 public:
  /// `rule` states the allowed values: "must be ...".
  ConstantError(const std::string& constant, const std::string& given, const std::string& rule)
      : ConstantError(constant + " = " + given + ": " + rule, constant, given, rule) {}

  std::string name;     ///< Name of the constant, or a formula.
  std::string value;    ///< Value as given; empty if missing.
  std::string allowed;  ///< "must be ...".

 protected:
  ConstantError(const std::string& text, std::string constant, std::string given, std::string rule)
      : std::invalid_argument(text),
        name(std::move(constant)),
        value(std::move(given)),
        allowed(std::move(rule)) {}
};

/// Moduli of an isotropic law at rest.
struct Moduli {
  double mu;     ///< Shear modulus [Pa].
  double kappa;  ///< Bulk modulus [Pa].

  double lambda() const { return kappa - 2.0 / 3.0 * mu; }  ///< Lame's first constant [Pa].
};

/// mu = E / (2 (1 + nu)), kappa = E / (3 (1 - 2 nu)).
Moduli moduliFromYoung(double young_modulus, double poisson_ratio);

/// {"young_modulus", "poisson_ratio", "mu", "kappa"}: the names that readModuli() accepts.
std::vector<std::string> modulusNames();

/// Reads either (young_modulus, poisson_ratio) or (mu, kappa).
/// @throws ConstantError: young_modulus, mu or kappa not > 0; poisson_ratio not in (-1, 0.5).
/// @throws std::invalid_argument: both pairs mixed, or neither complete.
Moduli readModuli(const Constants& constants);

}  // namespace palpate::material
