// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/solver/integrator.h"
#include "palpate/solver/minimizer_list.h"

namespace palpate::tissue {

/// How a cycle of finite elements may be solved; the first is the default.
std::vector<std::string> methodNames();

/// What a method is and takes. Whoever treats methods differently asks here and knows no names.
struct MethodFacts : solver::MinimizerFacts {
  std::string name;
  bool explicit_steps = false;
  bool viscous = true;            ///< It takes bodies with viscous terms.
  bool stiffness_damping = true;  ///< It takes damping in proportion to stiffness.
  bool spring_damping = true;     ///< It takes supports that damp.
  bool pressures = true;          ///< It takes pressures on faces.
  bool friction = true;           ///< It takes friction in contact.
  bool fluids = true;             ///< And contents of cavities that resist a change of volume.
  bool needles = true;            ///< It takes needles that go in.
  bool prescribes = false;        ///< It takes contact that is prescribed: contact_models.h.
  /// What it takes as the settings' integrator.
  std::vector<std::string> integrators = solver::integratorNames();
  /// How it gets along without one, after "the method ..."; empty where it uses the integrator.
  std::string own_integration;
};

/// Of "auto" nothing but what it takes: what is solved by it has another method, see
/// TissueModel::methods().
/// @throws std::invalid_argument for a name that is not one of methodNames().
MethodFacts methodFacts(const std::string& name);

}  // namespace palpate::tissue
