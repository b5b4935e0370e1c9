// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_body.h"

#include <algorithm>
#include <cmath>

#include "palpate/fem/elasticity.h"
#include "palpate/material/material.h"
#include "palpate/tissue/method_facts.h"

namespace palpate::torture {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Constants of laws that are stresses; the others are dimensionless.
const std::vector<std::string>& stresses() {
  static const std::vector<std::string> kNames = {"c10", "c01", "c1",  "c2", "c3", "a",
                                                  "af",  "as",  "afs", "mu", "k1", "c"};
  return kNames;
}

// Whether the model takes only laws without fibres and viscosity: all models but fem.
bool isPlain(const std::string& model) { return model != "fem"; }

std::string drawModel(Draw* draw) {
  static const std::vector<std::string> kOthers = {
      "mass_spring", "tensor_mass", "cloth", "hybrid", "sampled_elasticity", "honeycomb", "bem"};
  return draw->chance(0.75) ? "fem" : draw->oneOf(kOthers);
}

}  // namespace

material::Constants stiffened(material::Constants constants, double times) {
  for (const char* name :
       {"young_modulus", "c10", "c01", "c1", "c2", "c3", "a", "af", "as", "afs", "mu", "k1", "c"}) {
    const auto found = constants.find(name);
    if (found == constants.end()) continue;
    for (double& value : found->second) value *= times;
  }
  return constants;
}

material::Constants constantsOf(const std::string& law, double young, double poisson) {
  if (has(material::constantNames(law), "young_modulus")) {
    return {{"young_modulus", {young}}, {"poisson_ratio", {poisson}}};
  }
  material::Constants constants = material::exampleConstants(law);
  constants.erase("kappa");
  constants["poisson_ratio"] = {poisson};
  const double mu = material::moduli(material::makeMaterial(law, constants)).mu;
  const double factor = young / (2.0 * (1.0 + poisson)) / mu;
  for (auto& [name, values] : constants) {
    if (!has(stresses(), name)) continue;
    for (double& value : values) value *= factor;
  }
  return constants;
}

void drawBody(Draw* draw, TortureOrgan* organ) {
  static const std::vector<std::string> kSchemes = {"implicit", "symplectic_euler",
                                                    "trapezoidal_euler", "forward_euler"};
  static const std::vector<double> kPoisson = {0.0, 0.3, 0.45, 0.49, 0.499, 0.4999};
  organ->model = drawModel(draw);
  organ->element = draw->oneOf(fem::elementNames());
  if (organ->model == "mass_spring" || organ->model == "cloth") {
    organ->scheme = draw->oneOf(kSchemes);
    // Sheets are too stiff in bending for explicit steps of the other two schemes.
    if (organ->model == "cloth" && organ->scheme != "implicit") organ->scheme = kSchemes[1];
  }
  organ->law = draw->oneOf(material::materialNames());
  const bool fibres = material::needsFibres(
      material::makeMaterial(organ->law, material::exampleConstants(organ->law)));
  if (isPlain(organ->model) && fibres) organ->law = "neo_hookean";
  organ->young = draw->chance(0.6) ? draw->decades(1e3, 1e5) : draw->decades(1e2, 1e8);
  organ->poisson = draw->oneOf(kPoisson);
  organ->density = draw->chance(0.6) ? draw->between(900.0, 1100.0) : draw->decades(1.0, 1e5);
  organ->constants = constantsOf(organ->law, organ->young, organ->poisson);
  const bool turns = material::isFrameIndifferent(
      material::makeMaterial(organ->law, material::exampleConstants(organ->law)));
  if (organ->model == "fem" && turns && draw->chance(0.15)) {
    organ->prony_g = draw->between(0.1, 0.8);
    organ->prony_tau = draw->decades(1e-3, 0.3) / slowestFrequency(*organ);
  }
}

void drawMethod(Draw* draw, TortureScene* scene) {
  static const std::vector<std::string> kMethods = {
      "implicit_pcg", "implicit_pcg", "implicit_pcg",       "implicit_direct", "implicit_async",
      "lbfgs",        "tled",         "linear_precomputed", "newton_bicgstab", "auto"};
  scene->method = draw->oneOf(kMethods);
  // The linear part of hybrid models needs implicit steps.
  const bool implicit = scene->method.rfind("implicit", 0) == 0 || scene->method == "lbfgs";
  if (scene->organs.front().model == "hybrid" && !implicit) scene->method = kMethods.front();
  const tissue::MethodFacts facts = tissue::methodFacts(scene->method);
  for (TortureOrgan& organ : scene->organs) {
    if (!facts.viscous) organ.prony_g = 0.0;
    if (scene->method == "newton_bicgstab" && organ.element == "p1p1") organ.element = "tet4";
    if (scene->method == "linear_precomputed") organ.adapt = 0.0;
  }
  if (!facts.friction) scene->friction = 0.0;
  if (facts.own_integration.empty()) scene->integrator = draw->oneOf(facts.integrators);
  if (draw->chance(0.6) && has(facts.integrators, "backward_euler")) {
    scene->integrator = "backward_euler";
  }
  if (scene->start == Start::kThrown || !scene->organs.front().held) {
    if (scene->integrator == "static") scene->integrator = "backward_euler";
  }
}

// Lowest shear frequency between the held and the free side; lower for a stiff top on a soft base.
double slowestFrequency(const TortureOrgan& organ) {
  if (organ.model == "cloth") {
    // Bending of a beam clamped at both ends [Rao 2017, 8.5]; springs have half its stiffness.
    constexpr double kClamped = 4.730, kHalf = 0.5;
    const double k = kClamped / organ.size.y();
    return kHalf * k * k * kSheetThickness * std::sqrt(organ.young / (12.0 * organ.density));
  }
  const double mu = organ.young / (2.0 * (1.0 + organ.poisson));
  const double slow = organ.contrast > 1.0 ? 0.6 : 1.0;
  // EIGEN_PI is a long double
  return static_cast<double>(slow * 0.5 * EIGEN_PI * std::sqrt(mu / organ.density) /
                             organ.size.z());
}

void drawDamping(Draw* draw, const TortureScene& scene, TortureOrgan* organ) {
  const double omega = slowestFrequency(*organ);
  organ->mass_damping = std::min(draw->between(0.8, 1.6) * omega, 1e5);
  const bool takes = organ->model == "fem" && tissue::methodFacts(scene.method).stiffness_damping;
  if (takes && draw->chance(0.2)) organ->stiffness_damping = std::min(0.1 / omega, 1.0);
}

}  // namespace palpate::torture
