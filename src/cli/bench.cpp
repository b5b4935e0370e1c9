// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdlib.h>  // mkdtemp: POSIX

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>

#include "bench_report.h"
#include "command.h"
#include "commands.h"
#include "files.h"
#include "options.h"
#include "palpate/base/error.h"
#include "palpate/fem/elasticity.h"

namespace palpate::cli {
namespace {

struct BenchOptions {
  std::string scene, out;
  bool small = false;
  BenchChoice choice;
  std::map<std::string, std::string> shorthands;  // key of the scene -> value
  std::vector<std::string> sets;                  // KEY=VALUE
  std::optional<double> duration;
  double frame = 0.02;
  int repeats = 3;
  int cycles = 1;
  double seconds = std::numeric_limits<double>::infinity();
};

// For meshes and tools where nobody wants to keep them.
class WorkFolder {
 public:
  explicit WorkFolder(const std::string& wanted) {
    if (!wanted.empty()) {
      path_ = makeFolder(wanted).string();
      return;
    }
    std::error_code none;
    path_ = (std::filesystem::temp_directory_path(none) / "palpate_bench_XXXXXX").string();
    if (none || !mkdtemp(&path_[0])) {
      const char* folder = std::getenv("TMPDIR");
      throw InputError("environment", "TMPDIR", folder ? folder : "",
                       "must be a folder that can be written to, or give --out");
    }
    temporary_ = true;
  }
  ~WorkFolder() {
    std::error_code ignored;
    if (temporary_) std::filesystem::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  bool temporary_ = false;
};

Settings settingsFrom(const BenchOptions& options) {
  Settings settings(options.shorthands.begin(), options.shorthands.end());
  for (const std::string& set : options.sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos) {
      throw InputError("command line", "--set", set, "must be KEY=VALUE, as solver.step=0.005");
    }
    settings.emplace_back(set.substr(0, equals), set.substr(equals + 1));
  }
  return settings;
}

double poissonRatio(const scene::Scene& scene) {
  const auto& constants = scene.organs[0].material.constants;
  const auto found = constants.find("poisson_ratio");
  return found == constants.end() ? 0.0 : found->second.front();
}

BenchResult runScene(const BenchScene& scene, const BenchOptions& options,
                     const BenchChoice& choice, const std::string& folder, BenchTitle* title) {
  BenchCase bench = scene.make(choice, folder);
  if (bench.scene.file.empty()) bench.scene.file = folder + "/scene";
  for (scene::OrganConfig& organ : bench.scene.organs) {
    if (!choice.adapt) break;
    organ.adapt.finest = *choice.adapt;
    organ.adapt.growth = choice.growth.value_or(organ.adapt.growth);
  }
  applySettings(settingsFrom(options), &bench.scene);
  *title = {scene.name, bench.scene.organs[0].element, poissonRatio(bench.scene),
            settingsOf(bench.scene)};
  const double duration = options.duration.value_or(bench.duration);
  BenchResult result =
      runBench(bench, {duration, options.frame, options.repeats, options.cycles, options.seconds});
  std::cerr << result.note;
  return result;
}

int list() {
  for (const BenchScene& scene : benchScenes()) std::printf("%-12s %s\n", scene.name, scene.what);
  return kOk;
}

// A tenth of a second of every scene that is a box, on few tetrahedra.
int runSmall(BenchOptions options) {
  options.duration = options.duration.value_or(0.1);
  options.repeats = options.cycles = 1;
  bool usable = true;
  printBenchHead();
  for (const BenchScene& scene : benchScenes()) {
    if (scene.small_tets == 0) continue;
    if (!options.scene.empty() && scene.name != options.scene) continue;
    BenchChoice choice = options.choice;
    choice.tets = scene.small_tets;
    const std::string out = options.out.empty() ? "" : options.out + "/" + scene.name;
    const WorkFolder folder(out);
    BenchTitle title;
    const BenchResult result = runScene(scene, options, choice, folder.path(), &title);
    printBenchLine(scene.name, result);
    if (!out.empty()) writeBench(folder.path(), title, result);
    usable = usable && result.usable;
  }
  return usable ? kOk : kNotConverged;
}

int runBench(const BenchOptions& options) {
  if (options.duration) requirePositive("--duration", *options.duration);
  requirePositive("--frame", options.frame);
  if (options.choice.edge_length) requirePositive("--edge-length", *options.choice.edge_length);
  if (options.choice.finest) requirePositive("--finest", *options.choice.finest);
  if (options.choice.adapt) requirePositive("--adapt", *options.choice.adapt);
  if (options.choice.growth) requirePositive("--growth", *options.choice.growth);
  const std::vector<std::string> elements = fem::elementNames();
  const std::string element = options.choice.element.value_or(elements.front());
  if (!std::count(elements.begin(), elements.end(), element)) {
    throw InputError("command line", "--element", element, "must be one of " + joinNames(elements));
  }
  if (options.scene.empty()) return options.small ? runSmall(options) : list();
  const BenchScene& scene = benchScene(options.scene);
  if (options.small) {
    if (scene.small_tets > 0) return runSmall(options);
    throw InputError("command line", "--small", options.scene, "this scene has no small version");
  }
  const WorkFolder folder(options.out);
  BenchTitle title;
  const BenchResult result = runScene(scene, options, options.choice, folder.path(), &title);
  printBench(title, result);
  if (!options.out.empty()) writeBench(folder.path(), title, result);
  return result.usable ? kOk : kNotConverged;
}

}  // namespace

void addBench(CLI::App& app, Action& action) {
  Command command(app, "bench",
                  "Run one of several fixed scenes and measure it; without --scene, list them");
  const auto options = std::make_shared<BenchOptions>();
  command.option("--scene", &options->scene, "One of the list");
  command.flag("--small", &options->small, "Small versions of the scenes, in seconds");
  command.option("--tets", &options->choice.tets, "About so many tetrahedra (boxes)")
      .between(6, 2000000);
  command.option("--edge-length", &options->choice.edge_length,
                 "Of the tetrahedra [m] (livers, graded meshes)");
  command.option("--finest", &options->choice.finest,
                 "Of the tetrahedra where the tool goes [m]: a graded mesh");
  command.option("--adapt", &options->choice.adapt,
                 "Of the tetrahedra where the tool is [m]: the mesh follows it");
  command.option("--growth", &options->choice.growth,
                 "With --finest or --adapt: edge per distance");
  command.option("--poisson-ratio", &options->choice.poisson_ratio, "Of the soft material");
  command.option("--element", &options->choice.element, "Finite element");
  const auto shorthand = [&](const char* option, const char* key, const char* what) {
    command.option(
        option, [options, key](const std::string& value) { options->shorthands[key] = value; },
        what);
  };
  shorthand("--method", "solver.method", "Method of solution");
  shorthand("--integrator", "solver.integrator", "Time integration");
  shorthand("--step", "solver.step", "Length of a cycle [s]");
  shorthand("--tolerance", "solver.tolerance", "Of the unbalanced force, relative");
  shorthand("--linear-tolerance", "solver.linear_tolerance", "Of the linear solver, relative");
  shorthand("--max-newton", "solver.max_newton_iterations", "Newton iterations in a cycle");
  shorthand("--threads", "solver.threads", "Threads that share the work");
  command.option("--set", &options->sets,
                 "KEY=VALUE: any key of the scene's sections solver and contact");
  command.option("--duration", &options->duration, "Simulated time [s]");
  command.option("--frame", &options->frame, "Displacements are kept this far apart [s]");
  command.option("--repeat", &options->repeats, "Runs from the start; times are of all of them")
      .between(1, 1000);
  command.option("--cycles", &options->cycles, "More repeats, until so many cycles were run in all")
      .between(1, 1000000);
  command.option("--seconds", &options->seconds, "Begin no other repeat after so long");
  command.option("--out", &options->out,
                 "Folder for summary.json, forces.csv, times.csv, displacements.bin, mesh.vtu");
  command.onUse([options, &action] { action = [options] { return runBench(*options); }; });
}

}  // namespace palpate::cli
