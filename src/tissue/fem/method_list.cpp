// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "implicit_method.h"
#include "linear_method.h"
#include "method_choice.h"
#include "newton_method.h"
#include "palpate/base/error.h"
#include "palpate/solver/minimizer_list.h"
#include "step_method.h"
#include "tled_method.h"

namespace palpate::tissue {
namespace {

std::unique_ptr<StepMethod> implicit(const std::string& name, FemBody* body) {
  solver::MinimizerSettings settings;
  settings.max_linear_iterations = body->settings.max_linear_iterations;
  settings.keep_stiffness = body->settings.skip.unchanged_stiffness;
  settings.pool = body->pool;
  return std::make_unique<ImplicitMethod>(
      body, solver::makeMinimizer(name, settings, body->elasticity->makeMatrix()));
}

std::unique_ptr<StepMethod> tled(FemBody* body) { return std::make_unique<TledMethod>(body); }

std::unique_ptr<StepMethod> linearPrecomputed(FemBody* body) {
  return std::make_unique<LinearMethod>(body);
}

std::unique_ptr<StepMethod> newtonBicgstab(FemBody* body) {
  return std::make_unique<NewtonMethod>(body);
}

std::unique_ptr<StepMethod> automatic(FemBody* body) {
  const MethodChoice choice = chooseMethod(countCycle(body));
  body->method_note = choice.reason;
  return makeStepMethod(choice.method, body);
}

// Every method beside those of solver::minimizerNames(), the first of which is the default. To add
// one: write its header and source, add it here.
struct Entry {
  const char* name;
  std::unique_ptr<StepMethod> (*make)(FemBody*);
};
const std::vector<Entry> kMethods = {
    {"tled", tled},
    {"linear_precomputed", linearPrecomputed},
    {"newton_bicgstab", newtonBicgstab},
    {"auto", automatic},
};

}  // namespace

std::vector<std::string> methodNames() {
  std::vector<std::string> names = solver::minimizerNames();
  for (const Entry& entry : kMethods) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<StepMethod> makeStepMethod(const std::string& name, FemBody* body) {
  for (const std::string& known : solver::minimizerNames()) {
    if (name == known) return implicit(name, body);
  }
  for (const Entry& entry : kMethods) {
    if (name == entry.name) return entry.make(body);
  }
  throw std::invalid_argument("method = " + name + ": must be one of " + joinNames(methodNames()));
}

}  // namespace palpate::tissue
