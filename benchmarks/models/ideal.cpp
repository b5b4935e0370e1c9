// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/ideal_springs.h"

#include <cmath>

#include "palpate/io/json.h"
#include "parts.h"

namespace palpate::models {
namespace {

using springs::IdealSprings;

// Rest lengths in U, square errors in B^2/U^3, up to the curvature sqrt(2)/(part U).
std::string leastErrors(const IdealSprings& springs, double B, double U, double part) {
  const double rho = std::sqrt(2.0) / (part * U), unit = B * B / (U * U * U);
  const double L1 = springs.structuralRestLength(rho), L2 = springs.flexionRestLength(rho);
  io::JsonMembers out;
  out.add("structural_rest_length", L1 / U);
  out.add("flexion_rest_length", L2 / U);
  out.add("structural_error_at_0", springs.structuralError(0.0, rho) / unit);
  out.add("flexion_error_at_6U", springs.flexionError(6 * U, rho) / unit);
  out.add("structural_error_at_best", springs.structuralError(L1, rho) / unit);
  out.add("flexion_error_at_best", springs.flexionError(L2, rho) / unit);
  return out.object();
}

}  // namespace

std::string ideal(bool /*quick*/) {
  const double E = 1.0e7, h = 0.1, U = 1.0;
  const springs::BeamSection beam = springs::rectangularSection(E, h, h);
  const springs::Sheet sheet{E, 0.3, h};
  const double of_sheet = 1.3 * sheet.bendingStiffness() * U / std::sqrt(3.0);
  io::JsonMembers out;
  out.add("beam", leastErrors(IdealSprings::ofBeam(beam, U), E * beam.second_moment, U, 1.0));
  out.add("beam_of_tenth_curvature",
          leastErrors(IdealSprings::ofBeam(beam, U), E * beam.second_moment, U, 10.0));
  out.add("beam_of_unit_curvature",
          leastErrors(IdealSprings::ofBeam(beam, U), E * beam.second_moment, U, std::sqrt(2.0)));
  out.add("triangles", leastErrors(IdealSprings::ofTriangles(sheet, U), of_sheet, U, 10.0));
  return out.object();
}

}  // namespace palpate::models
