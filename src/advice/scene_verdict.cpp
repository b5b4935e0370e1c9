// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/advice/scene_verdict.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "advice.h"
#include "palpate/scene/tissue_file.h"
#include "palpate/tissue/skips.h"

namespace palpate::advice {
namespace {

double poissonRatio(const material::Solid& solid) {
  const material::Moduli m = material::moduli(solid.law);
  return (3.0 * m.kappa - 2.0 * m.mu) / (2.0 * (3.0 * m.kappa + m.mu));
}

double largestPoissonRatio(const scene::Scene& scene) {
  double largest = -1.0;
  for (std::size_t i = 0; i < scene.organs.size(); ++i) {
    const scene::OrganConfig& organ = scene.organs[i];
    const std::string key = "organs[" + std::to_string(i) + "]";
    largest = std::max(largest, poissonRatio(scene::makeSolid(organ.material, scene.file, key)));
    for (const scene::RegionConfig& region : organ.regions) {
      if (!region.material) continue;
      largest =
          std::max(largest, poissonRatio(scene::makeSolid(*region.material, scene.file, key)));
    }
  }
  return largest;
}

std::string milliseconds(double seconds) {
  std::ostringstream text;
  text << std::setprecision(3) << 1e3 * seconds << " ms";
  return text.str();
}

std::string whatCosts(const SceneVerdict& verdict) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << 100.0 * verdict.share
       << " % of the slowest cycles is " << toString(verdict.costliest);
  return text.str();
}

}  // namespace

SceneFacts sceneFacts(const sim::Simulator& simulator, int cores) {
  const scene::Scene& scene = simulator.scene();
  SceneFacts facts;
  facts.rates = scene.rates;
  facts.solver = scene.solver;
  facts.contact = scene.contact;
  facts.cores = cores;
  int largest = 0;
  for (int i = 0; i < simulator.numOrgans(); ++i) {
    const int nodes = static_cast<int>(simulator.positions(i).cols());
    facts.nodes += nodes;
    if (nodes > simulator.positions(largest).cols()) largest = i;
  }
  const scene::OrganConfig& organ = scene.organs[static_cast<std::size_t>(largest)];
  facts.organ = organ.name;
  const std::vector<std::string> methods = simulator.methods(largest);
  if (!methods.empty()) facts.method = tissue::methodFacts(methods.front());
  facts.meshed = !organ.surface.empty();
  facts.graded = !organ.edge_length.uniform();
  facts.finest = organ.adapt.finest;
  facts.edge_length = mesh::meanEdgeLength(simulator.cells(largest));
  facts.poisson_ratio = largestPoissonRatio(scene);
  return facts;
}

SceneVerdict judgeScene(const SceneFacts& facts, const CycleCosts& figures) {
  SceneVerdict verdict;
  verdict.rate_wanted = facts.rates.simulation;
  if (figures.cycles == 0 || !(figures.cycle_p99 > 0.0)) return verdict;
  verdict.rate_possible = 1.0 / figures.cycle_p99;
  verdict.rate_typical = figures.cycle_median > 0.0 ? 1.0 / figures.cycle_median : 0.0;
  verdict.too_heavy = verdict.rate_possible < verdict.rate_wanted;
  for (std::size_t k = 0; k < kNumCyclePhases; ++k) {
    const Phase phase = static_cast<Phase>(k);
    if (figures.slow[phase] > figures.slow[verdict.costliest]) verdict.costliest = phase;
  }
  const double slow = figures.slow.cycle();
  verdict.share = slow > 0.0 ? figures.slow[verdict.costliest] / slow : 0.0;
  if (verdict.too_heavy && slow > 0.0) verdict.advice = adviseOn(facts, figures);
  return verdict;
}

std::string shortText(const SceneVerdict& verdict) {
  if (verdict.rate_possible == 0.0) return "no cycle was measured";
  std::ostringstream text;
  text << std::setprecision(3) << "99 of 100 cycles hold " << verdict.rate_possible << " Hz, "
       << verdict.rate_wanted << " Hz are wanted";
  if (verdict.too_heavy) text << "; " << whatCosts(verdict);
  if (!verdict.advice.empty()) text << "; " << verdict.advice.front().text;
  return text.str();
}

std::string longText(const SceneVerdict& verdict) {
  if (verdict.rate_possible == 0.0) return "no cycle was measured\n";
  std::ostringstream text;
  text << std::setprecision(3) << "is the scene too heavy for " << verdict.rate_wanted << " Hz?  ";
  if (verdict.too_heavy) {
    text << "yes, by a factor of " << verdict.rate_wanted / verdict.rate_possible << "\n";
  } else {
    text << "no\n";
  }
  text << "  rate possible: " << verdict.rate_possible << " Hz in 99 of 100 cycles, "
       << verdict.rate_typical << " Hz in half of them\n"
       << "  costliest: " << whatCosts(verdict) << "\n";
  if (!verdict.advice.empty()) {
    text << "  what to change, with the estimated time of the slowest cycles (now "
         << milliseconds(1.0 / verdict.rate_possible) << ", wanted "
         << milliseconds(1.0 / verdict.rate_wanted) << "):\n";
  }
  for (const Advice& advice : verdict.advice) {
    text << "    " << milliseconds(advice.cycle) << ": " << advice.text << "\n";
  }
  return text.str();
}

std::string profileTable(const CycleCosts& figures) {
  std::ostringstream text;
  const double cycle = figures.total.cycle();
  text << std::fixed << std::setprecision(3) << "phase          median ms    p99 ms   share\n";
  for (std::size_t k = 0; k < kNumCyclePhases; ++k) {
    const Phase phase = static_cast<Phase>(k);
    text << std::left << std::setw(14) << toString(phase) << std::right << std::setw(10)
         << 1e3 * figures.median[phase] << std::setw(10) << 1e3 * figures.p99[phase]
         << std::setprecision(1) << std::setw(6)
         << (cycle > 0.0 ? 100.0 * figures.total[phase] / cycle : 0.0) << " %\n"
         << std::setprecision(3);
  }
  text << std::setprecision(2) << "Newton iterations per step " << figures.newton_per_cycle
       << ", linear iterations per Newton iteration " << figures.linear_per_newton << "\n"
       << "skipped in " << figures.cycles << " steps:";
  const char* separator = " ";
  for (const tissue::Skip& skip : tissue::skips()) {
    if (!skip.count) continue;
    text << separator << skip.counter << " " << figures.skipped.*skip.count;
    separator = ", ";
  }
  text << "\n";
  return text.str();
}

}  // namespace palpate::advice
