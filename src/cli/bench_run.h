// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "bench_scenes.h"
#include "palpate/sim/simulator.h"

namespace palpate::cli {

/// One cycle, without its time: the same bits in every repeat.
struct BenchCycle {
  double t;       ///< At its end [s].
  Wrench wrench;  ///< Of instrument 0, spatial; zero where there is none.
  sim::StepReport report;
};

/// What running a case gave.
struct BenchResult {
  int nodes = 0, tets = 0;  ///< Of all organs.
  double load_seconds = 0.0;
  double loaded_megabytes = 0.0, peak_megabytes = 0.0;  ///< Resident memory of the process [MB].
  std::vector<BenchCycle> cycles;
  std::vector<std::vector<double>> milliseconds;  ///< Of each repeat, one a cycle.
  std::vector<double> frame_times;                ///< [s]
  std::vector<Points> frames;  ///< Displacements of organ 0 at these times, 3 x n [m].
  mesh::CellMesh mesh;         ///< Organ 0 at rest.
  std::string note;            ///< Of loading.
  bool same_bits = true;       ///< All repeats gave the forces of the first.
  bool usable = true;          ///< No cycle failed.
};

struct BenchTiming {
  double duration;  ///< Simulated [s].
  double frame;     ///< Displacements are kept this far apart [s].
  int repeats;      ///< From the start each time; at least so many,
  int cycles;       ///< and at least so many cycles in all repeats,
  double seconds;   ///< but no other repeat begins later than this [s].
};

/// Runs the case: sim::Simulator, one cycle a step of the scene. Time is taken around
/// Simulator::step() alone. @throws InputError as Simulator.
BenchResult runBench(const BenchCase& bench, const BenchTiming& timing);

}  // namespace palpate::cli
