// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/structured_springs.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/base/number.h"
#include "palpate/springs/ideal_springs.h"

namespace palpate::springs {
namespace {

StencilSpring of(const ForceLine& line) { return {line.force, line.slope}; }

}  // namespace

LineSprings bendingLineSprings(const BeamSection& beam, double spacing) {
  const IdealSprings ideal = IdealSprings::ofBeam(beam, spacing);
  return {of(ideal.structuralLimit()), of(ideal.flexionLimit())};
}

LineSprings lineSprings(const BeamSection& beam, double spacing, double flexion_stiffness) {
  LineSprings springs = bendingLineSprings(beam, spacing);
  const double largest = 0.25 * beam.young_modulus * beam.area / spacing;
  if (!(flexion_stiffness >= 0.0 && flexion_stiffness <= largest)) {
    throw std::invalid_argument("flexion_stiffness = " + formatNumber(flexion_stiffness) +
                                "; must be in [0, " + formatNumber(largest) + "]");
  }
  springs.structural.stiffness = 4.0 * (largest - flexion_stiffness);
  springs.flexion.stiffness = flexion_stiffness;
  return springs;
}

RectangleSprings rectangleSprings(const Sheet& sheet, double spacing, Constants constants) {
  check(sheet);
  requirePositive("spacing", spacing);
  const double h = sheet.thickness, U = spacing;
  if (h * h > 2.0 * U * U) {
    throw std::invalid_argument("thickness = " + formatNumber(h) +
                                "; must be <= sqrt(2) times the spacing");
  }
  const double Eh = sheet.young_modulus * h / (1.0 - sheet.poisson_ratio);
  const double P1 = Eh * h * h / (2.0 * U);
  const double denominator = constants == Constants::kPrinted ? 8.0 : 4.0;
  const double k1 = Eh * (2.0 * U * U + h * h) / (denominator * U * U);
  const double k3 = Eh * (2.0 * U * U - h * h) / (8.0 * U * U);
  return {{P1, k1}, {-0.25 * P1, 0.0}, {-0.25 * std::sqrt(2.0) * P1, k3}};
}

TriangleSprings bendingTriangleSprings(const Sheet& sheet, double spacing) {
  const IdealSprings ideal = IdealSprings::ofTriangles(sheet, spacing);
  return {of(ideal.structuralLimit()), of(ideal.flexionLimit())};
}

TriangleSprings triangleSprings(const Sheet& sheet, double spacing) {
  TriangleSprings springs = bendingTriangleSprings(sheet, spacing);
  springs.structural.stiffness =
      sheet.young_modulus * sheet.thickness / (std::sqrt(3.0) * (1.0 - sheet.poisson_ratio));
  springs.flexion.stiffness = 0.0;
  return springs;
}

CubeSprings cubeSprings(double young_modulus, double edge, CubeDiagonals diagonals,
                        Constants constants) {
  requirePositive("young_modulus", young_modulus);
  requirePositive("edge", edge);
  const double Eh = (constants == Constants::kPrinted ? 2.0 : 1.0) * young_modulus * edge;
  if (diagonals == CubeDiagonals::kFaces) return {0.4 * Eh, 0.4 * Eh, 0.0};
  return {0.8 * Eh, 0.0, 0.3 * Eh};
}

}  // namespace palpate::springs
