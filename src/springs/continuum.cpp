// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/continuum.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/base/number.h"

namespace palpate::springs {

void requirePositive(const char* name, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw std::invalid_argument(std::string(name) + " = " + formatNumber(value) + "; must be > 0");
}

void check(const BeamSection& beam) {
  requirePositive("young_modulus", beam.young_modulus);
  requirePositive("area", beam.area);
  requirePositive("second_moment", beam.second_moment);
}

void check(const Sheet& sheet) {
  requirePositive("young_modulus", sheet.young_modulus);
  requirePositive("thickness", sheet.thickness);
  if (!(sheet.poisson_ratio > -1.0 && sheet.poisson_ratio < 0.5)) {
    throw std::invalid_argument("poisson_ratio = " + formatNumber(sheet.poisson_ratio) +
                                "; must be in (-1, 0.5)");
  }
}

}  // namespace palpate::springs
