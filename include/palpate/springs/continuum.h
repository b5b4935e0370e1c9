// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::springs {

/// A straight elastic bar to be represented by springs.
struct BeamSection {
  double young_modulus;  ///< E [Pa], > 0
  double area;           ///< A [m^2], > 0
  double second_moment;  ///< I [m^4], > 0; b h^3 / 12 for a rectangle.
};

/// A thin elastic sheet.
struct Sheet {
  double young_modulus;  ///< E [Pa], > 0
  double poisson_ratio;  ///< nu, in (-1, 0.5). The springs always contract as for 1/3.
  double thickness;      ///< h [m], > 0

  /// D = E h^3 / (12 (1 - nu^2)) [N m].
  double bendingStiffness() const {
    return young_modulus * thickness * thickness * thickness /
           (12.0 * (1.0 - poisson_ratio * poisson_ratio));
  }
};

/// Width b, height h [m], bent along h.
inline BeamSection rectangularSection(double young_modulus, double b, double h) {
  return {young_modulus, b * h, b * h * h * h / 12.0};
}

/// @throws std::invalid_argument naming the constant and the allowed values.
void check(const BeamSection& beam);
void check(const Sheet& sheet);
/// Checks a spacing, step, density or the like, as check().
void requirePositive(const char* name, double value);

/// Constants of the theory, or as printed in [Wang 2005] where these differ, to reproduce its
/// tables.
enum class Constants { kCorrected, kPrinted };

}  // namespace palpate::springs
