// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "palpate/torture/scene_files.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// What a run may take. Only what takes too long depends on how fast the machine is.
struct RunLimits {
  double cycle = 60.0;  ///< A cycle that takes longer is ended, and has failed [s].
  double scene = 60.0;  ///< A run that takes longer is left off and judged by what it did [s].
  double live = 0.02;   ///< Deadline of live cycles, or two steps of the scene if longer [s].
  int threads = 1;
  /// A pattern by which cycles are asked to end after a number of questions, without a clock, until
  /// half of the rest after the tools is over; 0: they are not.
  int cuts = 0;
  /// Sleeps until this steadySeconds(), for live loops that keep time; null: they go on at once.
  std::function<void(double)> sleep_until;
};

/// A criterion that was not met, where first.
struct Failure {
  std::string criterion;
  std::size_t row = 0;
  std::string what;
};

/// How a scene went.
struct Outcome {
  std::string refused;  ///< What loading said, of a scene that does not load; nothing else then.
  std::vector<Failure> failures;
  bool whole = true;  ///< Not left off.
  int cycles = 0, unsolved = 0, inverted = 0, touching = 0;
  int curled = 0;    ///< Converged cycles with quadratic elements inverted at a corner.
  int put_back = 0;  ///< Cycles that an organ was put back to rest in, rolled back or frozen.
  std::ptrdiff_t points = 0;
  double load_s = 0.0, run_s = 0.0, median_ms = 0.0, longest_ms = 0.0;
  double peak_force = 0.0;  ///< [N]
  std::vector<std::uint64_t> hashes;

  bool passed() const { return refused.empty() && failures.empty(); }
  bool fails(const std::string& criterion) const;
};

/// Writes the scene into `folder`, which must be there, and replays it as `palpate replay` does.
/// @throws InputError where files cannot be written.
Outcome run(const TortureScene& scene, const std::string& folder, const RunLimits& limits);

}  // namespace palpate::torture
