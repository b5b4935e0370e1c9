// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "progress_line.h"

namespace palpate::cli {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin, double per_second) {
  return per_second * std::chrono::duration<double>(Clock::now() - begin).count();
}

// A line of /proc/self/status, in MB; 0 where there is no such file.
double statusMegabytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    double kilobytes = 0.0;
    std::istringstream(line.substr(key.size())) >> kilobytes;
    return kilobytes / 1024.0;
  }
  return 0.0;
}

// To the start of the case, as if it had just been loaded.
void rewind(const BenchCase& bench, sim::Simulator* simulator) {
  simulator->reset();
  if (bench.start_velocity.isZero()) return;
  for (int i = 0; i < simulator->numOrgans(); ++i) {
    const Points positions = simulator->positions(i);
    const Points rest = simulator->cells(i).points;
    Points velocities = bench.start_velocity.replicate(1, positions.cols());
    for (const scene::SupportConfig& support :
         bench.scene.organs[static_cast<std::size_t>(i)].supports) {
      for (int node : mesh::selectPoints(rest, support.select)) velocities.col(node).setZero();
    }
    simulator->setPositions(i, positions, velocities);
  }
}

std::vector<sim::LinkPoses> posesAt(double t, const BenchCase& bench,
                                    const sim::Simulator& simulator) {
  std::vector<sim::LinkPoses> poses;
  poses.reserve(static_cast<std::size_t>(simulator.numInstruments()));
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    poses.push_back(simulator.linkPoses(i, bench.joints(t)));
  }
  return poses;
}

// Of the points of organ 0 that it has at the start, which it keeps when its mesh is refined.
Points displacement(const sim::Simulator& simulator, const mesh::CellMesh& start) {
  const Points& x = simulator.positions(0);
  const mesh::CellMesh now = simulator.cells(0);
  const auto key = [](const Points& points, Eigen::Index i) {
    return std::array<double, 3>{points(0, i), points(1, i), points(2, i)};
  };
  std::map<std::array<double, 3>, Eigen::Index> at;
  for (Eigen::Index i = 0; i < x.cols(); ++i) at[key(now.points, i)] = i;
  Points moved(3, start.points.cols());
  for (Eigen::Index i = 0; i < moved.cols(); ++i) moved.col(i) = x.col(at.at(key(start.points, i)));
  return moved - start.points;
}

bool isMultiple(double t, double frame) {
  return std::abs(t / frame - std::round(t / frame)) < 1e-6;
}

BenchCycle cycleOf(double t, const sim::StepResult& result) {
  return {t, result.instruments.empty() ? Wrench() : result.instruments[0].spatial, result.report};
}

bool sameBits(const Wrench& a, const Wrench& b) {
  return a.force == b.force && a.torque == b.torque;
}

}  // namespace

BenchResult runBench(const BenchCase& bench, const BenchTiming& timing) {
  BenchResult result;
  start::ProgressLine line;
  const auto begin = Clock::now();
  sim::Simulator simulator(
      bench.scene, [&](const std::string& what, double fraction) { line.show(what, fraction); });
  line.finish();
  result.load_seconds = since(begin, 1.0);
  result.loaded_megabytes = statusMegabytes("VmRSS:");
  result.mesh = simulator.cells(0);
  for (int i = 0; i < simulator.numOrgans(); ++i) {
    const mesh::CellMesh mesh = simulator.cells(i);
    result.nodes += static_cast<int>(mesh.numPoints());
    result.tets += static_cast<int>(mesh.numCells());
  }
  for (const std::string& warning : simulator.warnings()) result.note += warning + "\n";
  for (const std::string& note : simulator.notes()) result.note += note + "\n";

  const bool adapts = bench.scene.organs[0].adapt.on();
  const double step = bench.scene.solver.step;
  const int cycles = std::max(1, static_cast<int>(std::lround(timing.duration / step)));
  const auto first = Clock::now();
  for (int repeat = 0; repeat < timing.repeats || repeat * cycles < timing.cycles; ++repeat) {
    if (repeat > 0 && since(first, 1.0) > timing.seconds) break;
    rewind(bench, &simulator);
    std::vector<double> milliseconds;
    for (int k = 1; k <= cycles; ++k) {
      const double t = k * step;
      const std::vector<sim::LinkPoses> poses = posesAt(t, bench, simulator);
      const auto start = Clock::now();
      const sim::StepResult& done = simulator.step(poses, step);
      milliseconds.push_back(since(start, 1.0e3));
      if (repeat == 0) {
        result.cycles.push_back(cycleOf(t, done));
        result.usable &= done.report.usable();
        if (isMultiple(t, timing.frame) || k == cycles) {
          result.frame_times.push_back(t);
          result.frames.push_back(adapts ? displacement(simulator, result.mesh)
                                         : Points(simulator.positions(0) - result.mesh.points));
        }
      } else {
        result.same_bits &= sameBits(cycleOf(t, done).wrench, result.cycles[k - 1].wrench);
      }
      line.show("repeat " + std::to_string(repeat + 1), static_cast<double>(k) / cycles);
    }
    result.milliseconds.push_back(milliseconds);
  }
  line.finish();
  result.peak_megabytes = statusMegabytes("VmHWM:");
  return result;
}

}  // namespace palpate::cli
