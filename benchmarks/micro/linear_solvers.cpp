// SPDX-License-Identifier: GPL-3.0-or-later
// Linear solves of a step of 10 ms: conjugate gradients by the iteration, CHOLMOD as a whole.
#include <string>

#include "body.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"

namespace palpate::micro {
namespace {

void pcg(benchmark::State& state, const std::string& element, int cells, double tolerance) {
  const Body body(cells, element, "stable_neo_hookean");
  const fem::Stiffness A = stepMatrix(body);
  const Points b = pushOnTop(body);
  Points x(3, b.cols());
  solver::BlockPcg solver(1000);
  int iterations = solver.solve(A, b, tolerance, &x).iterations;
  for (auto _ : state) iterations = solver.solve(A, b, tolerance, &x).iterations;
  state.counters["iterations"] = iterations;
  state.counters["per_iteration"] = benchmark::Counter(
      iterations, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// The first solve analyses the pattern, later ones only factor and solve.
void cholmod(benchmark::State& state, const std::string& element, int cells, bool analyse) {
  const Body body(cells, element, "stable_neo_hookean");
  const fem::Stiffness A = stepMatrix(body);
  const Points b = pushOnTop(body);
  Points x(3, b.cols());
  solver::CholmodSolver kept;
  kept.solve(A, b, 1e-9, &x);
  for (auto _ : state) {
    if (analyse) {
      solver::CholmodSolver fresh;
      fresh.solve(A, b, 1e-9, &x);
    } else {
      kept.beginCycle(0.0);  // in which the first matrix is factorised
      kept.solve(A, b, 1e-9, &x);
    }
  }
}

const bool kAdded = [] {
  for (const char* element : {"tet4", "anp"}) {
    for (const int cells : {9, 15}) {
      const std::string of =
          std::string("/") + element + "/tets:" + std::to_string(6 * cells * cells * cells);
      for (const char* tolerance : {"1e-2", "1e-6"}) {
        benchmark::RegisterBenchmark(
            ("pcg" + of + "/to:" + tolerance).c_str(),
            [=](benchmark::State& state) { pcg(state, element, cells, std::stod(tolerance)); })
            ->Unit(benchmark::kMillisecond);
      }
      benchmark::RegisterBenchmark(
          ("cholmod_analyse+factor+solve" + of).c_str(),
          [=](benchmark::State& state) { cholmod(state, element, cells, true); })
          ->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark(
          ("cholmod_factor+solve" + of).c_str(),
          [=](benchmark::State& state) { cholmod(state, element, cells, false); })
          ->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace palpate::micro
