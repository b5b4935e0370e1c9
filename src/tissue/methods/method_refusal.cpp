// SPDX-License-Identifier: GPL-3.0-or-later
#include "method_refusal.h"

#include <algorithm>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/contact/contact_models.h"

namespace palpate::tissue {

namespace {

std::string prescribingMethods() {
  std::vector<std::string> names;
  for (const std::string& name : methodNames()) {
    if (methodFacts(name).prescribes) names.push_back(name);
  }
  return joinNames(names);
}

// Whether the element's faces are triangles of the surface.
std::string prescriptionRefusal(const MethodFacts& method, const FemBody& body) {
  const std::string what = "contact.model = " + body.settings.contact.model + ": ";
  if (!method.prescribes) {
    return what + "method " + method.name + " takes a response; choose method " +
           prescribingMethods();
  }
  if (fem::isQuadratic(body.settings.element)) {
    return what + "needs flat faces, element " + body.settings.element +
           " has curved ones; choose anp or tet4";
  }
  return "";
}

}  // namespace

std::string methodRefusal(const MethodFacts& method, const FemBody& body) {
  const FemSettings& settings = body.settings;
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
  if (!method.viscous && body.elasticity->viscous()) {
    return refusal("", "has no memory for a viscoelastic material", "leave viscoelastic out");
  }
  if (!method.spring_damping && body.surroundings.damps()) {
    return refusal("", "knows no damping of supports",
                   "leave normal_damping, tangential_damping out");
  }
  if (!method.pressures && body.surroundings.presses()) {
    return refusal("",
                   "computes its answers before it begins and knows no pressure that follows the "
                   "deformed faces",
                   "leave pressure out");
  }
  if (!method.friction && settings.contact.friction_with.any()) {
    return refusal("contact.friction: ", "has what touches stick, whatever its friction",
                   "leave the key out");
  }
  if (!method.fluids && body.surroundings.resistsVolumes()) {
    return refusal("", "knows no content that resists a change of its volume",
                   "leave volume_stiffness out");
  }
  if (!method.needles && settings.needles) {
    return refusal("", "knows no needle that goes in", "leave the instruments' needle out");
  }
  if (contact::isPrescribed(settings.contact)) return prescriptionRefusal(method, body);
  return "";
}

}  // namespace palpate::tissue
