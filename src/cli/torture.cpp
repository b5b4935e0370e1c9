// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "command.h"
#include "commands.h"
#include "palpate/tissue/method_facts.h"
#include "palpate/tissue/model_list.h"
#include "palpate/torture/result_table.h"
#include "palpate/torture/torture_report.h"
#include "progress_line.h"
#include "tortures.h"

namespace palpate::cli {
namespace {

bool isWanted(const TortureOptions& options, const torture::TortureScene& scene) {
  if (!options.category.empty() && scene.category != options.category) return false;
  if (!options.model.empty() && scene.organs.front().model != options.model) return false;
  return options.tetrahedra == 0 ||
         scene.organs.front().mesh.numTets() <= static_cast<Eigen::Index>(options.tetrahedra);
}

// Numbers that need not be run: all that have a line, or of these those that passed.
std::set<int> numbersToSkip(const TortureOptions& options) {
  const std::vector<torture::ResultLine> lines = torture::readResults(options.out);
  const auto seed = static_cast<std::uint64_t>(options.seed);
  std::set<int> done = torture::numbersDone(lines, seed);
  if (!options.again) return done;
  for (const int number : torture::numbersAgain(lines, seed, options.commit)) done.erase(number);
  return done;
}

int runTortures(const TortureOptions& options) {
  if (!options.report.empty()) {
    std::cout << torture::stabilityMarkdown(torture::readResults(options.report));
    return kOk;
  }
  if (!options.table.empty()) {
    std::cout << torture::resultTable(torture::readResults(options.table));
    return kOk;
  }
  const Part part = readPart(options.part);
  Tortures all(options, part);
  all.noteCrash();
  const std::set<int> done = numbersToSkip(options);
  const auto begin = std::chrono::steady_clock::now();
  const int first = options.only.value_or(options.first);
  const int end = options.only ? first + 1 : options.first + options.count;
  std::vector<torture::ResultLine> lines;
  start::ProgressLine progress;
  for (int number = first; number < end; ++number) {
    if (number % part.of != part.number - 1 && !options.only) continue;
    if (done.count(number) && !options.only) continue;
    const torture::TortureScene scene = all.drawn(number);
    if (!options.only && !isWanted(options, scene)) continue;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    if (options.minutes > 0.0 && took.count() > 60.0 * options.minutes) break;
    lines.push_back(all.runOne(scene));
    const torture::ResultLine& line = lines.back();
    if (line.cell("verdict") == "failed" || options.only) {
      progress.finish();
      std::cout << number << " " << line.cell("verdict") << " " << line.cell("what") << " ["
                << torture::describe(scene) << "]\n";
      if (line.cell("verdict") == "failed") std::cout << "  " << all.commandOf(scene) << "\n";
      std::cout << std::flush;
    }
    progress.show("torture", static_cast<double>(number + 1 - first) / (end - first));
  }
  progress.finish();
  std::cout << torture::summary(lines) << "\n";
  for (const torture::ResultLine& line : lines) {
    if (line.cell("verdict") == "failed") return kNotConverged;
  }
  return kOk;
}

}  // namespace

void addTorture(CLI::App& app, Action& action) {
  Command command(app, "torture", "Run random scenes and look whether anything blows up");
  const auto options = std::make_shared<TortureOptions>();
  command.option("--count", &options->count, "So many scenes").positive();
  command.option("--first", &options->first, "The first one's number");
  command.option("--seed", &options->seed, "Of all that is drawn");
  command.option("--only", &options->only, "One scene of this number alone, run anew");
  command.option("--out", &options->out,
                 "Folder: tables of results, which are gone on from, and the scenes that failed");
  command.option("--part", &options->part, "i/n: every n-th scene, from the i-th");
  command.option("--minutes", &options->minutes, "Begin no scene after so many; 0: go on");
  command.option("--category", &options->category, "Scenes of one category alone")
      .oneOf(torture::categories());
  command.option("--model", &options->model, "Scenes of one tissue model alone")
      .oneOf(tissue::modelNames());
  command
      .option("--method", &options->method,
              "Solve by this one in place of the drawn one, to compare: into another folder")
      .oneOf(tissue::methodNames());
  command.option("--tetrahedra", &options->tetrahedra, "Scenes of at most so many; 0: all");
  command.option("--scene-limit", &options->scene_limit, "Leave a scene off after so long [s]");
  command.option("--cycle-limit", &options->cycle_limit, "End a cycle after so long [s]");
  command.option("--shrink", &options->shrink,
                 "Make a scene that failed plainer for so long [s]; 0: leave it");
  command.option("--report", &options->report,
                 "Write docs/results/stability.md of the tables in this folder, and run nothing");
  command.option("--table", &options->table,
                 "Write one table of those in this folder, and run nothing");
  command.option("--commit", &options->commit, "Noted beside each scene: what it was run by");
  command.flag("--again", &options->again,
               "Run also what failed or was left off by another commit");
  command.flag("--keep", &options->keep, "Keep the files of all scenes");
  command.onUse([options, &action] { action = [options] { return runTortures(*options); }; });
}

}  // namespace palpate::cli
