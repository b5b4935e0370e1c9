// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "blas_check.h"
#include "command.h"
#include "commands.h"
#include "files.h"
#include "palpate/advice/mesh_verdict.h"
#include "palpate/advice/scene_verdict.h"
#include "palpate/base/error.h"
#include "palpate/base/percentiles.h"
#include "palpate/formats/trajectory.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/io/csv_writer.h"
#include "palpate/io/replay.h"
#include "palpate/io/state_file.h"
#include "palpate/sim/lockstep.h"
#include "progress_line.h"
#include "shipped.h"

namespace palpate::cli {
namespace {

struct ReplayOptions {
  std::string scene, trajectory, out, vtu, initial_state, save_state;
  int every = 10;
  int threads = 0;
  bool live = false, profile = false;
};

// One file an organ: <organ>_<number>.vtu, at rest with the points' displacement.
void writePictures(const sim::Simulator& simulator, const std::filesystem::path& folder,
                   std::size_t number) {
  for (int i = 0; i < simulator.numOrgans(); ++i) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "_%06zu.vtu", number);
    const mesh::CellMesh rest = simulator.cells(i);
    const Points displacement = simulator.positions(i) - rest.points;
    formats::writeVtu((folder / (simulator.organName(i) + digits)).string(), rest,
                      {{"displacement", displacement}}, {});
  }
}

void printSummary(const io::Replay& replay, const std::vector<double>& step_ms) {
  const Percentiles ms = percentiles(step_ms);
  std::printf("peak force %.4g N, contacts at most %d, steps %zu (%d not converged)\n",
              replay.peakForce(), replay.mostContacts(), step_ms.size(), replay.failedSteps());
  if (replay.meshErrorAtPeak() > 0.0) {
    std::printf("of that the mesh's error is about %.2g N (docs/meshes.md)\n",
                replay.meshErrorAtPeak());
  }
  std::printf("step time p50 %.3f, p99 %.3f, max %.3f ms\n", ms.p50, ms.p99, ms.max);
}

void printProfile(const sim::Simulator& simulator, const advice::CycleCosts& figures) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const advice::SceneVerdict verdict =
      advice::judgeScene(advice::sceneFacts(simulator, cores), figures);
  std::printf("\n%s\n%s", advice::profileTable(figures).c_str(), advice::longText(verdict).c_str());
}

// Where the organs' methods need a fast BLAS, or the user asks where the time goes.
void checkBlas(const sim::Simulator& simulator, bool profile) {
  if (!profile && !simulator.wantsFastBlas()) return;
  const std::string warning = start::blasWarning();
  if (!warning.empty()) std::cerr << "warning: " << warning << "\n";
}

// That which was given, or that of the shipped scene, which is said.
std::string trajectoryFor(const ReplayOptions& options, const std::string& scene_file) {
  if (!options.trajectory.empty()) return options.trajectory;
  std::string shipped = start::shippedTrajectory(scene_file);
  if (shipped.empty()) {
    throw InputError("command line", "--trajectory", "",
                     "is missing: " + options.scene + " is no scene that comes with one");
  }
  std::cerr << "note: the trajectory is " << shipped << "\n";
  return shipped;
}

int replay(ReplayOptions options) {
  const std::string scene_file = start::sceneFile(options.scene);
  scene::Scene scene = scene::readScene(scene_file);
  options.trajectory = trajectoryFor(options, scene_file);
  if (options.threads > 0) scene.solver.threads = options.threads;
  if (options.live) scene::driveByHands(&scene);
  const formats::Trajectory trajectory = formats::readTrajectory(options.trajectory);
  start::ProgressLine line;
  sim::Simulator simulator(
      scene, [&](const std::string& what, double fraction) { line.show(what, fraction); });
  line.finish();
  checkBlas(simulator, options.profile);
  for (const std::string& warning : simulator.warnings()) std::cerr << "note: " << warning << "\n";
  for (const std::string& note : advice::loadingNotes(simulator))
    std::cerr << "note: " << note << "\n";

  io::Replay run(&simulator, trajectory, options.trajectory,
                 options.live ? sim::Cycles::kLive : sim::Cycles::kByTime);
  if (!options.initial_state.empty()) {
    io::restoreState(options.initial_state, &simulator);
    run.resume();
  }
  io::CsvWriter csv(options.out, run.columns());
  std::optional<std::filesystem::path> pictures;
  if (!options.vtu.empty()) pictures = makeFolder(options.vtu);
  std::vector<double> step_ms;
  advice::CostRecorder recorder;
  while (run.hasNext()) {
    const auto begin = std::chrono::steady_clock::now();
    const sim::StepReport& report = run.next().report;
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - begin;
    step_ms.push_back(ms.count());
    recorder.add(report, 1e-3 * ms.count(), run.parts());
    run.writeRow(ms.count(), &csv);
    if (pictures && run.row() % options.every == 0) writePictures(simulator, *pictures, run.row());
    line.show("replaying " + options.trajectory, run.fraction());
  }
  line.finish();
  csv.close();
  if (!options.save_state.empty()) io::writeState(options.save_state, simulator.state());
  printSummary(run, step_ms);
  if (options.profile) printProfile(simulator, recorder.figures());
  return run.failedSteps() == 0 ? kOk : kNotConverged;
}

}  // namespace

void addReplay(CLI::App& app, Action& action) {
  Command command(app, "replay", "Drive a scene by a table of joint positions, as fast as it goes");
  const auto options = std::make_shared<ReplayOptions>();
  command
      .option("scene", &options->scene,
              "Scene file, see docs/scene_format.md, or name of a shipped scene")
      .required();
  command.option("--trajectory", &options->trajectory,
                 "CSV: t [s] and a column a joint [m or rad]; instrument/joint where the scene "
                 "has several instruments; that of a shipped scene, if not given");
  command.option("--out", &options->out, "CSV with wrenches and what each step did").required();
  command.option("--vtu", &options->vtu, "Folder for pictures of the organs");
  command.option("--every", &options->every, "A picture every so many rows").positive();
  command.option("--threads", &options->threads, "Instead of the scene's solver.threads")
      .between(1, 64);
  command.option("--initial-state", &options->initial_state,
                 "Go on from a state that the first row of the trajectory had led to");
  command.option("--save-state", &options->save_state, "File for the state at the end");
  command.flag("--live", &options->live,
               "The cycles of the live node: each row is one of solver.step, whatever t says, and "
               "tools follow as those of hands");
  command.flag("--profile", &options->profile,
               "Say where the time went, and what to change if the scene is too heavy");
  command.onUse([options, &action] { action = [options] { return replay(*options); }; });
}

}  // namespace palpate::cli
