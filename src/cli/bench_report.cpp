// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench_report.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "palpate/base/atomic_file.h"
#include "palpate/base/percentiles.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/io/csv_writer.h"
#include "palpate/io/json.h"
#include "palpate/io/output_file.h"

namespace palpate::cli {
namespace {

// Of the cycles of one repeat [ms]; `second` is a simulated one.
struct Times {
  double median, p99, max, second;
};

Times timesOf(const std::vector<double>& ms, double duration) {
  const double sum = std::accumulate(ms.begin(), ms.end(), 0.0);
  const Percentiles p = percentiles(ms);
  return {p.p50, p.p99, p.max, sum / duration};
}

// Four ways to say it: the fastest repeat as a whole; each figure's median over the repeats; the
// repeats' fastest time of each cycle, which other work on the machine spoils least (all repeats do
// the same work, bit for bit); and the cycles of all repeats together, which a percentile needs.
struct AllTimes {
  Times fastest, typical, quiet, pooled;
};

AllTimes allTimes(const BenchResult& result) {
  const double duration = result.cycles.back().t;
  std::vector<Times> repeats;
  std::vector<double> best = result.milliseconds.front(), all;
  for (const std::vector<double>& ms : result.milliseconds) {
    repeats.push_back(timesOf(ms, duration));
    all.insert(all.end(), ms.begin(), ms.end());
    for (std::size_t k = 0; k < ms.size(); ++k) best[k] = std::min(best[k], ms[k]);
  }
  const auto middle = [&](double Times::*figure) {
    std::vector<double> values;
    values.reserve(repeats.size());
    for (const Times& times : repeats) values.push_back(times.*figure);
    return quantile(values, 0.5);
  };
  const auto less = [](const Times& a, const Times& b) { return a.second < b.second; };
  return {
      *std::min_element(repeats.begin(), repeats.end(), less),
      {middle(&Times::median), middle(&Times::p99), middle(&Times::max), middle(&Times::second)},
      timesOf(best, duration),
      timesOf(all, duration * static_cast<double>(result.milliseconds.size()))};
}

// Sums over the cycles.
struct Work {
  double skipped = 0;  // may be many
  int newton = 0, linear = 0, sleeping = 0, limited = 0, failed = 0, cut = 0;
  double peak_force = 0.0;  // [N]
};

Work workOf(const BenchResult& result) {
  Work work;
  for (const BenchCycle& cycle : result.cycles) {
    work.newton += cycle.report.newton_iterations;
    work.linear += cycle.report.linear_iterations;
    work.skipped += static_cast<double>(cycle.report.skipped.total());
    work.sleeping += static_cast<int>(cycle.report.skipped.sleeping_organs);
    work.limited += cycle.report.status == solver::SolveStatus::kIterationLimit;
    work.failed += !cycle.report.usable();
    work.cut += cycle.report.time_steps > 1;
    work.peak_force = std::max(work.peak_force, cycle.wrench.force.norm());
  }
  return work;
}

std::string timesJson(const Times& times) {
  io::JsonMembers json;
  json.add("median_ms", times.median);
  json.add("p99_ms", times.p99);
  json.add("max_ms", times.max);
  json.add("ms_per_second", times.second);
  return json.object();
}

std::string count(int n) { return std::to_string(n); }

std::string summaryJson(const BenchTitle& title, const BenchResult& result) {
  const Work work = workOf(result);
  const AllTimes times = allTimes(result);
  io::JsonMembers settings, all(",\n  ");
  for (const auto& [key, value] : title.settings) settings.add(key, io::jsonText(value));
  all.add("scene", io::jsonText(title.scene));
  all.add("element", io::jsonText(title.element));
  all.add("poisson_ratio", title.poisson_ratio);
  all.add("settings", settings.object());
  all.add("tets", count(result.tets));
  all.add("nodes", count(result.nodes));
  all.add("cycles", count(static_cast<int>(result.cycles.size())));
  all.add("duration", result.cycles.back().t);
  all.add("repeats", count(static_cast<int>(result.milliseconds.size())));
  all.add("fastest", timesJson(times.fastest));
  all.add("typical", timesJson(times.typical));
  all.add("quiet", timesJson(times.quiet));
  all.add("pooled", timesJson(times.pooled));
  all.add("newton_iterations", count(work.newton));
  all.add("linear_iterations", count(work.linear));
  all.add("skipped", work.skipped);
  all.add("sleeping_cycles", count(work.sleeping));
  all.add("cycles_at_iteration_limit", count(work.limited));
  all.add("failed_cycles", count(work.failed));
  all.add("cycles_in_shorter_steps", count(work.cut));
  all.add("peak_force", work.peak_force);
  all.add("same_bits", result.same_bits ? "true" : "false");
  all.add("load_seconds", result.load_seconds);
  all.add("loaded_megabytes", result.loaded_megabytes);
  all.add("peak_megabytes", result.peak_megabytes);
  all.add("frame_times",
          io::json(Eigen::Map<const Eigen::VectorXd>(
              result.frame_times.data(), static_cast<Eigen::Index>(result.frame_times.size()))));
  return "{\n  " + all.text() + "\n}\n";
}

void writeForces(const std::string& file, const BenchResult& result) {
  io::CsvWriter csv(file, {"t", "fx", "fy", "fz", "tx", "ty", "tz", "contacts", "max_penetration",
                           "newton_iterations", "linear_iterations", "skipped", "min_jacobian",
                           "status", "mesh_error", "nodes", "mesh_changes"});
  for (const BenchCycle& cycle : result.cycles) {
    const sim::StepReport& report = cycle.report;
    csv << cycle.t;
    for (int i = 0; i < 3; ++i) csv << cycle.wrench.force[i];
    for (int i = 0; i < 3; ++i) csv << cycle.wrench.torque[i];
    csv << report.contacts << report.max_penetration << report.newton_iterations
        << report.linear_iterations << static_cast<double>(report.skipped.total())
        << report.min_jacobian << std::string(toString(report.status)) << report.mesh_error
        << report.nodes << report.mesh_changes;
    csv.endRow();
  }
  csv.close();
}

void writeTimes(const std::string& file, const BenchResult& result) {
  std::vector<std::string> head = {"t"};
  for (std::size_t r = 0; r < result.milliseconds.size(); ++r) {
    head.push_back("ms_" + std::to_string(r + 1));
  }
  io::CsvWriter csv(file, head);
  for (std::size_t k = 0; k < result.cycles.size(); ++k) {
    csv << result.cycles[k].t;
    for (const std::vector<double>& ms : result.milliseconds) csv << ms[k];
    csv.endRow();
  }
  csv.close();
}

void writeDisplacements(const std::string& file, const BenchResult& result) {
  io::OutputFile output(file);
  for (const Points& u : result.frames) {
    output.write(std::string(reinterpret_cast<const char*>(u.data()),
                             static_cast<std::size_t>(u.size()) * sizeof(double)));
  }
  output.close();
}

void printTimes(const char* name, const Times& times) {
  std::printf("  %-30s %9.3f %9.3f %9.3f %12.2f\n", name, times.median, times.p99, times.max,
              times.second);
}

}  // namespace

void printBench(const BenchTitle& title, const BenchResult& result) {
  const Work work = workOf(result);
  const AllTimes times = allTimes(result);
  std::printf("%s, %s, nu %g: %d tetrahedra, %d nodes\n", title.scene.c_str(),
              title.element.c_str(), title.poisson_ratio, result.tets, result.nodes);
  std::printf("  %zu cycles (%g s) x %zu\n", result.cycles.size(), result.cycles.back().t,
              result.milliseconds.size());
  std::printf("  %-30s %9s %9s %9s %12s\n", "ms a cycle", "median", "p99", "max", "ms/simul. s");
  printTimes("fastest repeat", times.fastest);
  printTimes("median of the repeats", times.typical);
  printTimes("each cycle's fastest", times.quiet);
  printTimes("all repeats together", times.pooled);
  std::printf("  Newton iterations %d, linear iterations %d, work skipped %.0f times\n",
              work.newton, work.linear, work.skipped);
  std::printf("  cycles at the iteration limit %d, in shorter steps %d, failed %d\n", work.limited,
              work.cut, work.failed);
  std::printf("  peak force %.6g N, loaded in %.2f s, memory %.0f MB (peak %.0f MB)\n",
              work.peak_force, result.load_seconds, result.loaded_megabytes, result.peak_megabytes);
  if (!result.same_bits) std::printf("  NOT the same bits in every repeat\n");
}

void printBenchHead() {
  std::printf("%-12s %8s %8s %8s %9s %9s %9s %8s %8s %11s\n", "scene", "tets", "nodes", "cycles",
              "median ms", "p99 ms", "max ms", "newton", "linear", "peak N");
}

void printBenchLine(const std::string& name, const BenchResult& result) {
  const Work work = workOf(result);
  const Times times = allTimes(result).fastest;
  std::printf("%-12s %8d %8d %8zu %9.3f %9.3f %9.3f %8d %8d %11.6g\n", name.c_str(), result.tets,
              result.nodes, result.cycles.size(), times.median, times.p99, times.max, work.newton,
              work.linear, work.peak_force);
}

void writeBench(const std::string& folder, const BenchTitle& title, const BenchResult& result) {
  writeForces(folder + "/forces.csv", result);
  writeTimes(folder + "/times.csv", result);
  writeDisplacements(folder + "/displacements.bin", result);
  formats::writeVtu(folder + "/mesh.vtu", result.mesh, {}, {});
  writeFileAtomically(folder + "/summary.json", summaryJson(title, result));
}

}  // namespace palpate::cli
