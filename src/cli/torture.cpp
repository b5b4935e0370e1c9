// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "command.h"
#include "commands.h"
#include "files.h"
#include "palpate/base/error.h"
#include "palpate/base/phase_times.h"
#include "palpate/tissue/model_list.h"
#include "palpate/torture/result_table.h"
#include "palpate/torture/shrink.h"
#include "palpate/torture/torture_report.h"
#include "progress_line.h"

namespace palpate::cli {
namespace {

struct TortureOptions {
  int count = 100, seed = 1, first = 0;
  std::optional<int> only;
  std::string out = "torture", part = "1/1", category, model, report;
  double minutes = 0.0, scene_limit = 60.0, cycle_limit = 60.0, shrink = 30.0;
  int tetrahedra = 0;
  bool keep = false;
};

struct Part {
  int number = 1, of = 1;
  std::string name() const { return std::to_string(number) + "_of_" + std::to_string(of); }
};

Part readPart(const std::string& text) {
  Part part;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%d/%d%c", &part.number, &part.of, &rest);
  if (read != 2 || part.of < 1 || part.number < 1 || part.number > part.of) {
    throw InputError("command line", "--part", text, "must be i/n, 1 <= i <= n: 2/4");
  }
  return part;
}

constexpr int kAgain = 10;  // every so manieth scene runs again by two threads

// What was drawn is run in a folder of its own, which stays where it failed.
class Tortures {
 public:
  Tortures(const TortureOptions& options, const Part& part)
      : options_(options),
        folder_(makeFolder(options.out)),
        table_((folder_ / ("results_" + part.name() + ".csv")).string()),
        running_((folder_ / ("running_" + part.name())).string()) {
    limits_.cycle = options.cycle_limit;
    limits_.scene = options.scene_limit;
    limits_.sleep_until = [](double time) {
      std::this_thread::sleep_for(std::chrono::duration<double>(time - steadySeconds()));
    };
  }

  // A scene in which the program ended the last time has failed.
  void noteCrash() {
    std::ifstream in(running_);
    int number = -1;
    if (!(in >> number)) return;
    in.close();
    const torture::TortureScene scene = drawn(number);
    torture::appendResult(table_, torture::crashLine(scene));
    std::filesystem::remove(running_);
  }

  torture::ResultLine runOne(const torture::TortureScene& scene) {
    std::ofstream(running_) << scene.number << "\n";
    const std::string folder =
        makeFolder((folder_ / ("scene_" + std::to_string(scene.number))).string());
    torture::Outcome outcome = torture::run(scene, folder, limits_);
    if (scene.number % kAgain == 0 && outcome.passed() && outcome.whole && !scene.live) {
      torture::RunLimits two = limits_;
      two.threads = 2;
      const torture::Outcome again = torture::run(scene, folder, two);
      // What was ended for its time goes on otherwise.
      const bool ended = !again.whole || again.fails("cycle");
      if (!ended && again.hashes != outcome.hashes) {
        outcome.failures.push_back({"same", 0, "two threads give other bits"});
      }
    }
    if (!outcome.failures.empty() && options_.shrink > 0.0) {
      const torture::Failure& failure = outcome.failures.front();
      const torture::TortureScene small =
          torture::shrunk(scene, failure, folder, limits_, options_.shrink);
      torture::run(small, folder, limits_);  // so that the files are those of the last that failed
    }
    const torture::ResultLine line = torture::resultLine(scene, outcome);
    torture::appendResult(table_, line);
    if (outcome.failures.empty() && !options_.keep) std::filesystem::remove_all(folder);
    std::filesystem::remove(running_);
    return line;
  }

  torture::TortureScene drawn(int number) const {
    return torture::drawScene(static_cast<std::uint64_t>(options_.seed), number);
  }
  std::string commandOf(const torture::TortureScene& scene) const {
    const std::string folder = (folder_ / ("scene_" + std::to_string(scene.number))).string();
    torture::SceneFiles files{folder + "/scene.yaml", folder + "/trajectory.csv", ""};
    if (scene.start != torture::Start::kRest) files.state = folder + "/start.state";
    return files.command();
  }

 private:
  const TortureOptions& options_;
  std::filesystem::path folder_;
  std::string table_, running_;
  torture::RunLimits limits_;
};

bool isWanted(const TortureOptions& options, const torture::TortureScene& scene) {
  if (!options.category.empty() && scene.category != options.category) return false;
  if (!options.model.empty() && scene.organs.front().model != options.model) return false;
  return options.tetrahedra == 0 ||
         scene.organs.front().mesh.numTets() <= static_cast<Eigen::Index>(options.tetrahedra);
}

int runTortures(const TortureOptions& options) {
  if (!options.report.empty()) {
    std::cout << torture::stabilityMarkdown(torture::readResults(options.report));
    return kOk;
  }
  const Part part = readPart(options.part);
  Tortures all(options, part);
  all.noteCrash();
  const std::set<int> done = torture::numbersDone(torture::readResults(options.out),
                                                  static_cast<std::uint64_t>(options.seed));
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
  command.option("--tetrahedra", &options->tetrahedra, "Scenes of at most so many; 0: all");
  command.option("--scene-limit", &options->scene_limit, "Leave a scene off after so long [s]");
  command.option("--cycle-limit", &options->cycle_limit, "End a cycle after so long [s]");
  command.option("--shrink", &options->shrink,
                 "Make a scene that failed plainer for so long [s]; 0: leave it");
  command.option("--report", &options->report,
                 "Write docs/stability.md of the tables in this folder, and run nothing");
  command.flag("--keep", &options->keep, "Keep the files of all scenes");
  command.onUse([options, &action] { action = [options] { return runTortures(*options); }; });
}

}  // namespace palpate::cli
