// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "command.h"
#include "commands.h"
#include "files.h"
#include "palpate/analysis/case_solver.h"
#include "palpate/io/csv_writer.h"
#include "palpate/io/result_json.h"
#include "progress_line.h"

namespace palpate::cli {
namespace {

struct SolveOptions {
  std::string case_file, out;
  int threads = 1;
};

void writeOutcome(const analysis::CaseOutcome& outcome, const std::filesystem::path& folder) {
  io::writeResultJson((folder / "result.json").string(), outcome.result);
  formats::writeVtu((folder / "result.vtu").string(), outcome.mesh, outcome.point_data,
                    outcome.cell_data);
  if (outcome.history.rows.empty()) return;
  io::CsvWriter csv((folder / "probes.csv").string(), outcome.history.columns);
  for (const std::vector<double>& row : outcome.history.rows) {
    for (double value : row) csv << value;
    csv.endRow();
  }
  csv.close();
}

int solve(const SolveOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const analysis::Case problem = analysis::readCase(options.case_file);
  const std::filesystem::path folder = makeFolder(options.out);
  start::ProgressLine line;
  analysis::CaseOutcome outcome = analysis::solveCase(
      problem, options.threads,
      [&](double fraction) { line.show("solving " + options.case_file, fraction); });
  line.finish();
  for (const std::string& note : outcome.notes) std::cerr << "note: " << note << "\n";
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  outcome.result.seconds = {{"total", seconds.count()}};
  writeOutcome(outcome, folder);
  if (outcome.result.load_factor < 1.0) {
    std::cerr << "note: converged for " << outcome.result.load_factor
              << " of the loads; what is written is that state\n";
  }
  std::cout << outcome.result.status << " after " << outcome.result.load_steps << " steps and "
            << outcome.result.newton_iterations << " Newton iterations, residual "
            << outcome.result.residual << " of the forces, " << seconds.count() << " s; see "
            << (folder / "result.json").string() << "\n";
  return outcome.converged ? kOk : kNotConverged;
}

}  // namespace

void addSolve(CLI::App& app, Action& action) {
  Command command(app, "solve",
                  "Solve a case file: static or dynamic finite elements with loads and supports");
  const auto options = std::make_shared<SolveOptions>();
  command.option("case", &options->case_file, "Case file, see docs/case_format.md").required();
  command
      .option("--out", &options->out,
              "Folder for result.json, result.vtu and, of a dynamic case, probes.csv")
      .required();
  command
      .option("--threads", &options->threads,
              "Threads that share the work; the results are the same bits for any")
      .between(1, 64);
  command.onUse([options, &action] { action = [options] { return solve(*options); }; });
}

}  // namespace palpate::cli
