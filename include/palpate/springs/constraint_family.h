// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::springs {

/// How far springs are from one kind of condition that the continuum puts on those of each point.
struct ConstraintFamily {
  std::string name;
  double scale;  ///< What a point's condition is measured against, mean [the condition's unit].
  double rms;    ///< Over all points, each relative to its own scale.
  double worst;  ///< Of any point, relative to its own scale.
};

/// How springs are fitted to an irregular mesh.
struct FitSettings {
  /// Time step of an explicit integrator [s] that bounds each stiffness, see largestStiffness().
  /// 0: there is no bound.
  double explicit_step = 0.0;
  /// Multiplies what the least squares give by one number, so that its mean over all points has the
  /// magnitude that the continuum demands. Least squares alone make springs too soft, for what asks
  /// for nothing is the nearer the smaller they are. Not in [Wang 2005].
  bool match_mean = false;
};

}  // namespace palpate::springs
