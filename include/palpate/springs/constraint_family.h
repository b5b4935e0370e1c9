// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::springs {

/// Violation of one family of the continuum's conditions by the springs.
struct ConstraintFamily {
  std::string name;
  double scale;  ///< Mean scale of the conditions, in the condition's unit.
  double rms;    ///< Root mean square over all points, relative to their scales.
  double worst;  ///< Largest value of all points, relative to its scale.
};

/// Settings of fitting springs to an irregular mesh.
struct FitSettings {
  /// Time step of an explicit integrator [s], which bounds each stiffness by largestStiffness().
  /// Zero: no bound.
  double explicit_step = 0.0;
  /// Scales the least-squares solution so that its mean over all points satisfies the continuum's
  /// condition. Least squares alone give too soft springs, since zero conditions favour small
  /// values. Not in [Wang 2005].
  bool match_mean = false;
};

}  // namespace palpate::springs
