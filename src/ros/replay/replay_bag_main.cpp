// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_replay_bag: a recorded motion through the simulation, every input, as fast as it goes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "bag_inputs.h"
#include "environment.h"
#include "palpate/advice/mesh_verdict.h"
#include "palpate/base/error.h"
#include "palpate/sim/lockstep.h"
#include "progress_line.h"
#include "replay_outputs.h"
#include "replay_summary.h"
#include "ros/input/tool_frames.h"
#include "ros/program/program.h"
#include "ros/program/throttle.h"
#include "ros/record/run_record.h"
#include "shipped.h"

namespace palpate::node {
namespace {

struct Options {
  std::string in, scene, out, csv, trajectory;
  bool live = false;
};

// Whoever compares the new results with recorded ones is to know that they are of something else.
void warnOfOthers(const Options& options, const BagInputs& inputs, const palpate::RunRecord& now) {
  constexpr std::size_t kMost = 12;  // lines
  for (const palpate::RunRecord& recorded : inputs.runRecords()) {
    if (programOf(recorded) != programOf(now)) {
      std::cerr << options.in << " was recorded by palpate " << programOf(recorded) << "; this is "
                << programOf(now) << '\n';
    }
    const std::vector<std::string> lines = differences(recorded, now);
    if (lines.empty()) continue;
    std::cerr << "WARNING: " << options.in << " was recorded with another scene than this, so its "
              << "wrenches are not those to expect here.\n  then: " << recorded.scene
              << "\n  now:  " << now.scene << '\n';
    for (std::size_t k = 0; k < std::min(lines.size(), kMost); ++k) {
      std::cerr << "  " << lines[k] << '\n';
    }
    if (lines.size() > kMost) std::cerr << "  and " << lines.size() - kMost << " more\n";
  }
}

void replay(const Options& options) {
  std::error_code ignored;
  if (std::filesystem::equivalent(options.in, options.out, ignored)) {
    throw InputError(options.out, "--out", "", "must be another file than the input");
  }
  scene::Scene scene = scene::readScene(start::sceneFile(options.scene));
  palpate::RunRecord record = recordOf(scene, "", ros::Time());
  if (options.live) scene::driveByHands(&scene);
  separateFrames(&scene);
  std::unique_ptr<sim::Simulator> simulator;
  {
    start::ProgressLine line;
    simulator = std::make_unique<sim::Simulator>(
        scene, [&](const std::string& what, double f) { line.show(what, f); });
  }
  for (const std::string& warning : simulator->warnings()) std::cerr << warning << '\n';
  for (const std::string& note : advice::loadingNotes(*simulator)) std::cerr << note << '\n';

  BagInputs inputs(options.in, *simulator);
  warnOfOthers(options, inputs, record);
  ReplayBag bag(options.out, simulator->scene());
  std::unique_ptr<TrajectoryCsv> trajectory;
  if (!options.trajectory.empty()) {
    trajectory = std::make_unique<TrajectoryCsv>(options.trajectory, *simulator);
  }
  std::unique_ptr<ResultCsv> csv;
  if (!options.csv.empty()) csv = std::make_unique<ResultCsv>(options.csv, simulator->scene());

  sim::Lockstep lockstep(simulator.get(), options.live ? sim::Cycles::kLive : sim::Cycles::kByTime);
  ReplaySummary summary(simulator->scene());
  bool started = false;
  ros::Time first;
  double last = 0.0;
  const Steady::time_point begin = Steady::now();
  {
    start::ProgressLine line;
    inputs.walk([&](const rosbag::MessageInstance& message,
                    const ros::Time& stamp) { bag.copy(message, stamp); },
                [&](const BagCycle& cycle) {
                  if (!started) {
                    first = record.header.stamp = cycle.stamp;
                    bag.write(record);
                  }
                  started = true;
                  last = bagTime(cycle.stamp, first);
                  const Steady::time_point start = Steady::now();
                  const sim::StepResult& result = lockstep.advance(last, cycle.poses);
                  const double ms = 1e3 * inSeconds(Steady::now() - start);
                  bag.write(cycle.stamp, result);
                  if (trajectory) trajectory->write(last, cycle.joints);
                  if (csv) csv->write(last, result, ms);
                  summary.add(result, ms);
                  line.show("replay", cycle.progress);
                });
  }
  if (!started) {
    const std::string& why = inputs.firstProblem();
    throw InputError(options.in, "", "", "has no usable input" + (why.empty() ? "" : ": " + why));
  }
  bag.finish();
  if (trajectory) trajectory->finish();
  if (csv) csv->finish();
  if (inputs.dropped() > 0) {
    std::cerr << inputs.dropped() << " messages dropped; the first: " << inputs.firstProblem()
              << '\n';
  }
  summary.print(std::cout, last, inSeconds(Steady::now() - begin), inputs.dropped());
}

}  // namespace
}  // namespace palpate::node

int main(int argc, char** argv) {
  palpate::start::restartWithSolverEnvironment(argv);
  palpate::start::keepFreedMemory();
  palpate::start::letLargeWritesFail();
  palpate::node::Options options;
  CLI::App app{"Replays a bag of instrument motion through a scene, in lockstep and repeatably"};
  app.add_option("bag", options.in, "bag with the motion (JointState topics or tf)")->required();
  app.add_option("--scene", options.scene, "scene file, or the name of a shipped scene")
      ->required();
  app.add_option("--out", options.out, "bag to write: wrenches, reports, the input")->required();
  app.add_option("--csv", options.csv, "also write results as palpate replay does");
  app.add_option("--trajectory", options.trajectory,
                 "also write the joints as a trajectory for palpate replay");
  app.add_flag("--live", options.live,
               "the cycles of the live node: each stamp is one of solver.step, and tools follow as "
               "those of hands");
  app.footer(
      "\nTopics read: <instrument>/measured_js (sensor_msgs/JointState; another one by the "
      "scene's\n"
      "joint_topic), or /tf and /tf_static with input: tf. Topics written, beside the copied "
      "ones:\n"
      "<instrument>/spatial/measured_cf and <instrument>/body/measured_cf\n"
      "(geometry_msgs/WrenchStamped), step_report (palpate/StepReport), run_record "
      "(palpate/RunRecord). Needs no master and has "
      "no\n"
      "parameters.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : palpate::node::kBadInput;
  }
  try {
    palpate::node::replay(options);
    return 0;
  } catch (const palpate::InputError& e) {
    std::cerr << e.what() << '\n';
    return palpate::node::kBadInput;
  } catch (const std::exception& e) {
    std::cerr << "palpate_replay_bag: " << e.what() << '\n';
    return 1;
  }
}
