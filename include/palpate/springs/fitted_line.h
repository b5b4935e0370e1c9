// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/springs/constraint_family.h"
#include "palpate/springs/continuum.h"
#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Springs, and the violation of their conditions.
struct LineFit {
  SpringNetwork network;
  std::vector<ConstraintFamily> preload;
  std::vector<ConstraintFamily> stiffness;
};

/// Weights of families of conditions in the least squares.
struct LineWeights {
  double bending = 1.0;
  double no_tension = 10.0;  ///< Larger values confine the disturbance due to ends.
  double stretch = 1.0;
  double evenness = 1.0;
};

/// Springs between neighbours and second neighbours of a straight bar with masses at `places` on
/// the x axis [m], ascending: 2 n - 3 springs for n masses [Wang 2005, 6.2]. With the spacings V,
/// V' on both sides of a mass, B = E I (V + V')/4 and C = E A (V + V')/4 (6.5, 6.29):
///
///     preload     sum P e = 0 exactly (6.23);  sum P U^3 = -48 B (6.15), sum P U = 0 (6.20)
///     stiffness   sum k U^2 = 4 C (6.32), sum k U e = 0 (6.34), 0 <= k <= M (6.35)
///
/// The sums are over the springs of a mass, of length U and direction e = +-1. All conditions but
/// the first and last are in the least squares, relative to their right-hand sides. (6.34) is left
/// out at the ends, where all springs have the same direction.
///
/// @throws std::invalid_argument for fewer than 3 masses, places not ascending, and as check().
LineFit fitLine(const BeamSection& beam, const Eigen::VectorXd& places, double line_density,
                const LineWeights& weights = {}, const FitSettings& settings = {});

}  // namespace palpate::springs
