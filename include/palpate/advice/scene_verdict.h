// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/advice/cycle_costs.h"
#include "palpate/sim/simulator.h"
#include "palpate/tissue/method_facts.h"

namespace palpate::advice {

/// What a scene asks for and consists of, as far as its cost depends on it. Of the organ with the
/// most nodes where one is meant.
struct SceneFacts {
  scene::RatesConfig rates;      ///< As the scene says it,
  scene::SolverConfig solver;    ///< likewise
  scene::ContactConfig contact;  ///< and likewise.
  /// By which the organ is solved: what the scene says or what `auto` took.
  tissue::MethodFacts method = tissue::methodFacts(scene::SolverConfig().method);
  int cores = 1;
  std::string organ;
  int nodes = 0;               ///< Of all organs.
  double edge_length = 0.0;    ///< Mean of the organ's tetrahedra [m].
  bool meshed = false;         ///< The organ is meshed with its key edge_length,
  bool graded = false;         ///< which says where edges are shorter.
  double finest = 0.0;         ///< Of organs[].adapt [m]; 0: its mesh never changes.
  double poisson_ratio = 0.0;  ///< Largest of all solids, at small strain.
};

/// `cores` of this machine. @throws InputError if a tissue file of the scene has gone.
SceneFacts sceneFacts(const sim::Simulator& simulator, int cores);

/// One change to the scene, and what the slowest cycles would then take.
struct Advice {
  std::string text;
  double cycle = 0.0;  ///< Estimated [s].
};

/// The answer to "is my scene too heavy?".
struct SceneVerdict {
  double rate_wanted = 0.0;
  double rate_possible = 0.0;  ///< 1 / p99 of the cycle: 99 of 100 cycles hold it; 0 if unknown.
  double rate_typical = 0.0;   ///< 1 / median.
  bool too_heavy = false;      ///< The possible rate is below the wanted one.
  Phase costliest = Phase::kOther;  ///< Of the slowest cycles,
  double share = 0.0;               ///< of whose time it is this part.
  std::vector<Advice> advice;       ///< Most effective first; empty unless too heavy.
};

/// Judges by the figures alone: no clock, no machine. Estimates are of orders: how time grows with
/// the number of nodes, of iterations and of threads (see load_advice.cpp).
SceneVerdict judgeScene(const SceneFacts& facts, const CycleCosts& figures);

/// The answer in a sentence, with the first advice: "holds 31 of 100 Hz; ...".
std::string shortText(const SceneVerdict& verdict);
/// The answer in lines, with all advice.
std::string longText(const SceneVerdict& verdict);
/// Times by phase, iterations and skipped work, as a table in lines.
std::string profileTable(const CycleCosts& figures);

}  // namespace palpate::advice
