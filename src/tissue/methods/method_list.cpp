// SPDX-License-Identifier: GPL-3.0-or-later
#include "method_list.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "method_choice.h"
#include "method_refusal.h"
#include "palpate/base/error.h"
#include "palpate/solver/minimizer_list.h"
#include "palpate/tissue/method_facts.h"
#include "tissue/methods/explicit/tled_or_implicit.h"
#include "tissue/methods/implicit/implicit_method.h"
#include "tissue/methods/linear/linear_method.h"
#include "tissue/methods/prescribed/prescribed_newton.h"

namespace palpate::tissue {
namespace {

std::unique_ptr<solver::Minimizer> minimizerOf(const std::string& name, FemBody* body) {
  solver::MinimizerSettings settings;
  settings.max_linear_iterations = body->settings.max_linear_iterations;
  settings.keep_stiffness = body->settings.skip.unchanged_stiffness;
  settings.pool = body->pool;
  settings.points = body->mesh.points;
  return solver::makeMinimizer(name, settings, body->elasticity->makeMatrix());
}

// Warns of factorisations longer than a cycle that are not background tasks.
void noteFactor(const std::string& name, const solver::Minimizer& minimizer, FemBody* body) {
  const double seconds = minimizer.factorSeconds(), step = body->settings.step;
  if (!(step > 0.0) || !(seconds > step)) return;
  std::ostringstream note;
  note << std::setprecision(2) << "method " << name << ": a cycle of " << step
       << " s waits for a factor of about " << seconds
       << " s now and then; implicit_pcg makes none, implicit_async makes it beside the cycles";
  body->method_note += (body->method_note.empty() ? "" : "; ") + note.str();
}

std::unique_ptr<StepMethod> implicit(const std::string& name, FemBody* body) {
  std::unique_ptr<solver::Minimizer> minimizer = minimizerOf(name, body);
  noteFactor(name, *minimizer, body);
  return std::make_unique<ImplicitMethod>(body, std::move(minimizer));
}

std::unique_ptr<StepMethod> tled(FemBody* body) {
  return std::make_unique<TledOrImplicit>(body, minimizerOf("implicit_pcg", body));
}

std::unique_ptr<StepMethod> linearPrecomputed(FemBody* body) {
  return std::make_unique<LinearMethod>(body);
}

std::unique_ptr<StepMethod> newtonBicgstab(FemBody* body) {
  return std::make_unique<PrescribedNewton>(body);
}

std::unique_ptr<StepMethod> automatic(FemBody* body) {
  const MethodChoice choice = chooseMethod(countCycle(body));
  body->method_note = choice.reason;
  return makeStepMethod(choice.method, body);
}

MethodFacts tledFacts() {
  MethodFacts facts;
  facts.for_auto = facts.explicit_steps = true;
  facts.stiffness_damping = facts.spring_damping = facts.needles = false;
  facts.integrators = {solver::integratorNames().front()};
  facts.own_integration = "has its own, central differences";
  return facts;
}

// The method computes velocities as differences over the cycle.
MethodFacts quasiStatic(solver::LinearSystems linear_systems) {
  MethodFacts facts;
  facts.linear_systems = linear_systems;
  facts.spring_damping = facts.needles = false;
  facts.integrators = {solver::integratorNames().front(), "static"};
  facts.own_integration = "is quasi-static and has none";
  return facts;
}

MethodFacts linearPrecomputedFacts() {
  MethodFacts facts = quasiStatic(solver::LinearSystems::kOldFactor);
  facts.viscous = facts.pressures = facts.fluids = false;
  return facts;
}

MethodFacts newtonBicgstabFacts() {
  MethodFacts facts = quasiStatic(solver::LinearSystems::kIterations);
  facts.fluids = facts.friction = false;
  facts.prescribes = true;
  return facts;
}

MethodFacts automaticFacts() { return {}; }

// All methods except those of solver::minimizerNames(), the first of which is the default. To add
// one: header, source, and a line here.
struct Entry {
  const char* name;
  std::unique_ptr<StepMethod> (*make)(FemBody*);
  MethodFacts (*facts)();
};
const std::vector<Entry> kMethods = {
    {"tled", tled, tledFacts},
    {"linear_precomputed", linearPrecomputed, linearPrecomputedFacts},
    {"newton_bicgstab", newtonBicgstab, newtonBicgstabFacts},
    {"auto", automatic, automaticFacts},
};

bool isMinimizer(const std::string& name) {
  const std::vector<std::string> names = solver::minimizerNames();
  return std::count(names.begin(), names.end(), name) > 0;
}

const Entry& find(const std::string& name) {
  for (const Entry& entry : kMethods) {
    if (name == entry.name) return entry;
  }
  throw std::invalid_argument("method = " + name + ": must be one of " + joinNames(methodNames()));
}

}  // namespace

std::vector<std::string> methodNames() {
  std::vector<std::string> names = solver::minimizerNames();
  for (const Entry& entry : kMethods) names.emplace_back(entry.name);
  return names;
}

MethodFacts methodFacts(const std::string& name) {
  MethodFacts facts;
  if (isMinimizer(name)) {
    static_cast<solver::MinimizerFacts&>(facts) = solver::minimizerFacts(name);
  } else {
    facts = find(name).facts();
  }
  facts.name = name;
  return facts;
}

std::unique_ptr<StepMethod> makeStepMethod(const std::string& name, FemBody* body) {
  const std::string refusal = methodRefusal(methodFacts(name), *body);
  if (!refusal.empty()) throw std::invalid_argument(refusal);
  body->method = name;  // `auto` replaces it by its choice
  return isMinimizer(name) ? implicit(name, body) : find(name).make(body);
}

}  // namespace palpate::tissue
