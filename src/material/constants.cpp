// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/material/constants.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace palpate::material {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The single number `name`, strictly between the bounds; refuses NaN.
double scalarBetween(const Constants& constants, const std::string& name, double low, double high) {
  const std::vector<double>& value = constants.at(name);
  if (value.size() == 1 && value[0] > low && value[0] < high) return value[0];
  std::ostringstream given, rule;
  for (std::size_t i = 0; i < value.size(); ++i) given << (i ? ", " : "") << value[i];
  rule << "must be one number ";
  if (high == kInfinity) {
    rule << "> " << low << ", finite";
  } else {
    rule << "in (" << low << ", " << high << ")";
  }
  throw ConstantError(name, given.str(), rule.str());
}

}  // namespace

Moduli moduliFromYoung(double young_modulus, double poisson_ratio) {
  return {young_modulus / (2.0 * (1.0 + poisson_ratio)),
          young_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio))};
}

std::vector<std::string> modulusNames() {
  return {"young_modulus", "poisson_ratio", "mu", "kappa"};
}

Moduli readModuli(const Constants& constants) {
  const bool young = constants.count("young_modulus"), poisson = constants.count("poisson_ratio");
  const bool mu = constants.count("mu"), kappa = constants.count("kappa");
  if (young && poisson && !mu && !kappa) {
    return moduliFromYoung(scalarBetween(constants, "young_modulus", 0.0, kInfinity),
                           scalarBetween(constants, "poisson_ratio", -1.0, 0.5));
  }
  if (mu && kappa && !young && !poisson) {
    return {scalarBetween(constants, "mu", 0.0, kInfinity),
            scalarBetween(constants, "kappa", 0.0, kInfinity)};
  }
  throw std::invalid_argument(
      "needs either young_modulus [Pa] and poisson_ratio, or mu [Pa] and kappa [Pa]");
}

}  // namespace palpate::material
