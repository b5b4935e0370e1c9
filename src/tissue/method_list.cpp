// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "implicit_method.h"
#include "palpate/base/error.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "step_method.h"

namespace palpate::tissue {
namespace {

std::unique_ptr<StepMethod> implicitPcg(FemBody* body) {
  return std::make_unique<ImplicitMethod>(
      body, std::make_unique<solver::BlockPcg>(body->settings.max_linear_iterations, body->pool));
}

std::unique_ptr<StepMethod> implicitDirect(FemBody* body) {
  return std::make_unique<ImplicitMethod>(body, std::make_unique<solver::CholmodSolver>());
}

// Every method; the first is the default. To add one: write its header and source, add it here.
struct Entry {
  const char* name;
  std::unique_ptr<StepMethod> (*make)(FemBody*);
};
constexpr Entry kMethods[] = {
    {"implicit_pcg", implicitPcg},
    {"implicit_direct", implicitDirect},
};

}  // namespace

std::vector<std::string> methodNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kMethods) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<StepMethod> makeStepMethod(const std::string& name, FemBody* body) {
  for (const Entry& entry : kMethods) {
    if (name == entry.name) return entry.make(body);
  }
  throw std::invalid_argument("method = " + name + ": must be one of " + joinNames(methodNames()));
}

}  // namespace palpate::tissue
