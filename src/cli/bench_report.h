// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "bench_run.h"
#include "settings.h"

namespace palpate::cli {

/// What was run, for the reports.
struct BenchTitle {
  std::string scene, element;
  double poisson_ratio;
  Settings settings;
};

/// A few lines for the eye.
void printBench(const BenchTitle& title, const BenchResult& result);

/// One line of the table that --small prints; `head` prints its first line.
void printBenchHead();
void printBenchLine(const std::string& name, const BenchResult& result);

/// Into the folder:
///   summary.json       what was run, sizes, times, iterations, memory
///   forces.csv         a row a cycle: t, force and torque on the tool, iterations, size and
///   changes of the
///                      mesh; no times
///   times.csv          a row a cycle: milliseconds in each repeat
///   displacements.bin  doubles, little endian: x y z of every node of organ 0, frame by frame at
///                      summary.json's frame_times; where the mesh adapts, of those of the mesh at
///                      rest
///   mesh.vtu           organ 0 at rest, its nodes in the same order
/// @throws InputError if one cannot be written.
void writeBench(const std::string& folder, const BenchTitle& title, const BenchResult& result);

}  // namespace palpate::cli
