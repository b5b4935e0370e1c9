// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "palpate/torture/scene_files.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Time limits of a run; only these depend on the machine's speed.
struct RunLimits {
  double cycle = 60.0;  ///< Longest cycle, which is stopped and fails [s].
  double scene = 60.0;  ///< Longest run, which is stopped and judged by the cycles done [s].
  double live = 0.02;   ///< Deadline of live cycles, or two steps of the scene if longer [s].
  int threads = 1;
  /// Random pattern that cuts cycles after a number of deadline queries, without a clock, until
  /// half of the rows after the tools; 0: none.
  int cuts = 0;
  /// Sleeps until this steadySeconds(), to run live loops in real time; null: no waiting.
  std::function<void(double)> sleep_until;
};

/// A violated criterion, with its first violation.
struct Failure {
  std::string criterion;
  std::size_t row = 0;
  std::string what;
};

/// Result of a scene.
struct Outcome {
  std::string refused;  ///< Message of a scene that does not load; the rest is then empty.
  std::vector<Failure> failures;
  bool whole = true;  ///< Whether the run was not stopped.
  int cycles = 0, unsolved = 0, inverted = 0, touching = 0;
  int curled = 0;    ///< Converged cycles with quadratic elements inverted at corners.
  int put_back = 0;  ///< Cycles in which an organ was reset, rolled back or skipped.
  std::ptrdiff_t points = 0;
  double load_s = 0.0, run_s = 0.0, median_ms = 0.0, longest_ms = 0.0;
  double peak_force = 0.0;  ///< [N]
  std::vector<std::uint64_t> hashes;

  bool passed() const { return refused.empty() && failures.empty(); }
  bool fails(const std::string& criterion) const;
};

/// Writes the scene into an existing `folder` and replays it as `palpate replay` does.
/// @throws InputError if files cannot be written.
Outcome run(const TortureScene& scene, const std::string& folder, const RunLimits& limits);

}  // namespace palpate::torture
