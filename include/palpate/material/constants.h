// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

namespace palpate::material {

/// What a user gives a law: names and numbers, as read from a file. A scalar is a list of one.
using Constants = std::map<std::string, std::vector<double>>;

/// The two moduli that every isotropic law has at rest.
struct Moduli {
  double mu;     ///< Shear modulus [Pa].
  double kappa;  ///< Bulk modulus [Pa].

  double lambda() const { return kappa - 2.0 / 3.0 * mu; }  ///< Lame's first constant [Pa].
};

/// mu = E / (2 (1 + nu)), kappa = E / (3 (1 - 2 nu)).
Moduli moduliFromYoung(double young_modulus, double poisson_ratio);

/// {"young_modulus", "poisson_ratio", "mu", "kappa"}: what readModuli() knows.
std::vector<std::string> modulusNames();

/// Reads either (young_modulus, poisson_ratio) or (mu, kappa).
/// @throws std::invalid_argument naming constant, value and range: both pairs mixed or neither
/// whole; young_modulus, mu or kappa not > 0; poisson_ratio not in (-1, 0.5).
Moduli readModuli(const Constants& constants);

}  // namespace palpate::material
