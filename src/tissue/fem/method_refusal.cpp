// SPDX-License-Identifier: GPL-3.0-or-later
#include "method_refusal.h"

#include <algorithm>

namespace palpate::tissue {

std::string methodRefusal(const MethodFacts& method, const FemSettings& settings, bool viscous) {
  const auto refusal = [&](const std::string& what, const std::string& why,
                           const std::string& remedy) {
    return what + "method " + method.name + " " + why + "; " + remedy +
           " or choose an implicit method";
  };
  const bool takes_integrator =
      std::count(method.integrators.begin(), method.integrators.end(), settings.integrator) > 0;
  if (!takes_integrator && !method.own_integration.empty()) {
    return refusal("integrator = " + settings.integrator + ": ", method.own_integration,
                   "leave the key out");
  }
  if (!method.stiffness_damping && settings.stiffness_damping != 0.0) {
    return refusal("damping.stiffness = " + std::to_string(settings.stiffness_damping) + ": ",
                   "damps in proportion to mass only", "set it to zero");
  }
  if (!method.viscous && viscous) {
    return refusal("", "has no memory for a viscoelastic material", "leave viscoelastic out");
  }
  return "";
}

}  // namespace palpate::tissue
