// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/springs/constraint_family.h"
#include "palpate/springs/continuum.h"
#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Springs and what they lack of their conditions.
struct LineFit {
  SpringNetwork network;
  std::vector<ConstraintFamily> preload;
  std::vector<ConstraintFamily> stiffness;
};

/// Weights of the families of conditions in the least squares.
struct LineWeights {
  double bending = 1.0;
  double no_tension = 10.0;  ///< Ends disturb the less of a line the larger this is.
  double stretch = 1.0;
  double evenness = 1.0;
};

/// Springs of a straight bar whose masses are at these places of the x axis [m], ascending, to
/// neighbours and second neighbours: 2 n - 3 of n masses [Wang 2005, 6.2]. With the spacings V
/// beside a mass, B = E I (V + V')/4 and C = E A (V + V')/4 (6.5, 6.29):
///
///     preload     sum P e = 0 exactly (6.23);  sum P U^3 = -48 B (6.15), sum P U = 0 (6.20)
///     stiffness   sum k U^2 = 4 C (6.32), sum k U e = 0 (6.34), 0 <= k <= M (6.35)
///
/// over the springs of a mass, U long, in direction e = +-1; all but the first and last in the
/// least squares, each over its right side's size. (6.34) is left out at the ends, whose springs
/// all go to one side.
///
/// @throws std::invalid_argument for fewer than 3 masses, places that do not ascend, and as
/// check().
LineFit fitLine(const BeamSection& beam, const Eigen::VectorXd& places, double line_density,
                const LineWeights& weights = {}, const FitSettings& settings = {});

}  // namespace palpate::springs
