// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/solver/integrator.h"
#include "palpate/solver/minimizer_list.h"

namespace palpate::tissue {

/// Names of all methods for cycles of finite elements; the first is the default.
std::vector<std::string> methodNames();

/// Capabilities of a method. Code that treats methods differently uses these, not names.
struct MethodFacts : solver::MinimizerFacts {
  std::string name;
  bool explicit_steps = false;
  bool viscous = true;            ///< Whether it supports viscous materials.
  bool stiffness_damping = true;  ///< Whether it supports stiffness-proportional damping.
  bool spring_damping = true;     ///< Whether it supports damped springs.
  bool pressures = true;          ///< Whether it supports pressures on faces.
  bool friction = true;           ///< Whether it supports friction.
  bool fluids = true;             ///< Whether it supports cavities that resist a change of volume.
  bool needles = true;            ///< Whether it supports needles.
  bool prescribes = false;        ///< Whether it supports contact model `prescribed`.
  /// Supported integrators.
  std::vector<std::string> integrators = solver::integratorNames();
  /// Its own integration, as text after "the method ..."; empty where it uses the integrator.
  std::string own_integration;
};

/// For "auto" only the capabilities are meaningful; TissueModel::methods() names the chosen method.
/// @throws std::invalid_argument for a name that is not one of methodNames().
MethodFacts methodFacts(const std::string& name);

}  // namespace palpate::tissue
