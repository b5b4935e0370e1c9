// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/minimizer_list.h"

#include <stdexcept>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/lbfgs.h"
#include "palpate/solver/newton.h"
#include "palpate/solver/pcg_or_factor.h"
#include "palpate/solver/stale_pcg.h"

namespace palpate::solver {
namespace {

std::unique_ptr<Minimizer> implicitPcg(const MinimizerSettings& settings, fem::Stiffness A) {
  return std::make_unique<Newton>(
      std::move(A),
      std::make_unique<PcgOrFactor>(
          BlockPcg(settings.max_linear_iterations, settings.pool, bestIsa(), settings.points)),
      settings.keep_stiffness, settings.pool);
}

std::unique_ptr<Minimizer> implicitDirect(const MinimizerSettings& settings, fem::Stiffness A) {
  return std::make_unique<Newton>(std::move(A), std::make_unique<CholmodSolver>(),
                                  settings.keep_stiffness, settings.pool);
}

std::unique_ptr<Minimizer> implicitAsync(const MinimizerSettings& settings, fem::Stiffness A) {
  auto linear = std::make_unique<StalePcg>(A, settings.max_linear_iterations,
                                           settings.pool && settings.pool->size() > 1);
  return std::make_unique<Newton>(std::move(A), std::move(linear), settings.keep_stiffness,
                                  settings.pool);
}

std::unique_ptr<Minimizer> lbfgs(const MinimizerSettings&, fem::Stiffness A) {
  return std::make_unique<Lbfgs>(std::move(A));
}

// To add one: write its header and source, list it here.
struct Entry {
  const char* name;
  std::unique_ptr<Minimizer> (*make)(const MinimizerSettings&, fem::Stiffness);
  MinimizerFacts facts;  // linear systems, needs fast BLAS, shares linear systems, for auto
};
constexpr Entry kMinimizers[] = {
    {"implicit_pcg", implicitPcg, {LinearSystems::kIterations, false, true, true}},
    {"implicit_direct", implicitDirect, {LinearSystems::kFactor, true, false, true}},
    {"implicit_async", implicitAsync, {LinearSystems::kOldFactor, true, false, false}},
    {"lbfgs", lbfgs, {LinearSystems::kOldFactor, true, false, true}},
};

const Entry& find(const std::string& name) {
  for (const Entry& entry : kMinimizers) {
    if (name == entry.name) return entry;
  }
  throw std::invalid_argument("method = " + name + ": must be one of " +
                              joinNames(minimizerNames()));
}

}  // namespace

std::vector<std::string> minimizerNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kMinimizers) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<Minimizer> makeMinimizer(const std::string& name, const MinimizerSettings& settings,
                                         fem::Stiffness A) {
  return find(name).make(settings, std::move(A));
}

MinimizerFacts minimizerFacts(const std::string& name) { return find(name).facts; }

}  // namespace palpate::solver
