// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/advice/cycle_costs.h"
#include "palpate/sim/simulator.h"
#include "palpate/tissue/method_facts.h"

namespace palpate::advice {

/// Facts of a scene that determine its cost. Per-organ facts are of the organ with the most nodes.
struct SceneFacts {
  scene::RatesConfig rates;      ///< As in the scene.
  scene::SolverConfig solver;    ///< As in the scene.
  scene::ContactConfig contact;  ///< As in the scene.
  /// Method of the organ, as in the scene or chosen by `auto`.
  tissue::MethodFacts method = tissue::methodFacts(scene::SolverConfig().method);
  int cores = 1;
  std::string organ;
  int nodes = 0;               ///< Sum over all organs.
  double edge_length = 0.0;    ///< Mean of the organ's tetrahedra [m].
  bool meshed = false;         ///< Whether the organ is meshed by its key edge_length.
  bool graded = false;         ///< Whether edge_length has refinement zones.
  double finest = 0.0;         ///< Of organs[].adapt [m]; 0: no adaptation.
  double poisson_ratio = 0.0;  ///< Largest of all solids, at small strains.
};

/// `cores` of this machine. @throws InputError for a missing tissue file of the scene.
SceneFacts sceneFacts(const sim::Simulator& simulator, int cores);

/// A change of the scene, with the estimated time of the slowest cycles.
struct Advice {
  std::string text;
  double cycle = 0.0;  ///< Estimated time of a slow cycle [s].
};

/// Whether a scene is too heavy, with reasons and advice.
struct SceneVerdict {
  double rate_wanted = 0.0;
  double rate_possible = 0.0;       ///< 1 / p99 of the cycle time, held by 99 % [Hz]; 0: unknown.
  double rate_typical = 0.0;        ///< 1 / median of the cycle time [Hz].
  bool too_heavy = false;           ///< Whether rate_possible is below the wanted rate.
  Phase costliest = Phase::kOther;  ///< Phase with the largest share of the slowest cycles.
  double share = 0.0;               ///< Share of that phase [-].
  std::vector<Advice> advice;       ///< Most effective first; only if too heavy.
};

/// Judges by figures alone, without clock or machine. Estimates are by orders of growth with nodes,
/// iterations and threads, see advice.cpp.
SceneVerdict judgeScene(const SceneFacts& facts, const CycleCosts& figures);

/// The verdict as a sentence, with the first advice: "holds 31 of 100 Hz; ...".
std::string shortText(const SceneVerdict& verdict);
/// The verdict in lines, with all advice.
std::string longText(const SceneVerdict& verdict);
/// Text table of times by phase, iterations and skipped work.
std::string profileTable(const CycleCosts& figures);

}  // namespace palpate::advice
