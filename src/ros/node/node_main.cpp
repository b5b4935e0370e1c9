// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_node: an instrument driven by ROS touches the organs of a scene.
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "blas_check.h"
#include "diagnostics.h"
#include "environment.h"
#include "node_help.h"
#include "palpate/advice/mesh_verdict.h"
#include "palpate/io/state_file.h"
#include "params.h"
#include "publishing_loop.h"
#include "ros/guard/crash.h"
#include "ros/guard/ending.h"
#include "ros/guard/master_watch.h"
#include "ros/haptics/haptic_loop.h"
#include "ros/input/input_factory.h"
#include "ros/input/tool_frames.h"
#include "ros/messages/topics.h"
#include "ros/program/callback_thread.h"
#include "ros/program/param_tree.h"
#include "ros/program/program.h"
#include "ros/program/realtime.h"
#include "ros/record/run_record.h"
#include "services.h"
#include "shipped.h"
#include "simulation_loop.h"
#include "state_folder.h"
#include "step_cores.h"

namespace palpate::node {
namespace {

// After the last zero: a step that is under way may come to its end, then its state is written.
// With a ramp of 0.1 s the program is gone in a second.
constexpr double kToEnd = 0.7, kToStep = 0.3;  // [s]

struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted while loading") {}
};

/// Results are the same bits for any number of threads.
void limitThreads(scene::SolverConfig* solver) {
  solver->threads = std::min(solver->threads, stepCores());
  solver->thread_for_tasks = solver->threads == 1;
}

/// Makes it, and says on the way what takes so long. Meshing can take minutes the first time.
std::unique_ptr<sim::Simulator> makeSimulator(const scene::Scene& scene, Diagnostics* diagnostics) {
  Throttle said(1.0);
  std::string last;
  auto simulator =
      std::make_unique<sim::Simulator>(scene, [&](const std::string& what, double fraction) {
        if (Ending::asked()) throw Interrupted();
        const bool due = said.due();
        if (what == last && !due) return;
        last = what;
        ROS_INFO("loading: %s, %.0f %%", what.c_str(), 100.0 * fraction);
        diagnostics->loading(what);
      });
  for (const std::string& warning : simulator->warnings()) ROS_WARN_STREAM(warning);
  for (const std::string& note : advice::loadingNotes(*simulator)) ROS_INFO_STREAM(note);
  diagnostics->setNotes(simulator->notes());
  diagnostics->setMeshAdvice(advice::adviseOnMeshes(*simulator));
  return simulator;
}

void sayHello(const sim::Simulator& simulator) {
  const scene::Scene& scene = simulator.scene();
  for (int i = 0; i < simulator.numOrgans(); ++i) {
    ROS_INFO("organ %s: %ld nodes", simulator.organName(i).c_str(),
             static_cast<long>(simulator.positions(i).cols()));
  }
  const double speed = scene.rates.simulation * scene.solver.step;
  if (std::abs(speed - 1.0) > 0.01) {
    ROS_WARN("rates.simulation x solver.step = %.3g: simulated time will run at %.3g of real time",
             speed, speed);
  }
}

/// Says so if the organs' methods need a BLAS that is faster than this one.
std::string checkBlas(const sim::Simulator& simulator) {
  if (!simulator.wantsFastBlas()) return "";
  const std::string warning = start::blasWarning();
  if (!warning.empty()) ROS_WARN_STREAM(warning);
  return warning;
}

/// The state after the last step that ended, to the one file for it; what cannot be saved is said,
/// and a failure of the program.
void saveAtEnd(LiveCycle* cycle, const StateFolder& states, Steady::time_point until) {
  try {
    const std::optional<sim::SimulatorState> state = cycle->state(until);
    if (!cycle->stepped()) return;
    if (state) {
      ROS_INFO_STREAM("the state at the end is in " << states.keepLast(*state));
    } else {
      Ending::fail("the state at the end is lost: the last step had to be abandoned");
    }
  } catch (const std::exception& error) {
    Ending::fail(std::string("the state at the end is lost: ") + error.what());
  }
}

/// `sends_realtime`: ROS's own threads do.
int run(bool sends_realtime) {
  ros::NodeHandle handle, private_handle("~");
  Diagnostics diagnostics;
  const ParamTree set(private_handle);
  const NodeParams params = readParams(set);
  scene::Scene scene = readScene(start::sceneFile(params.scene), set);
  const palpate::RunRecord record = recordOf(scene, params.initial_state, ros::Time::now());
  scene::driveByHands(&scene);
  limitThreads(&scene.solver);
  for (const std::string& name : separateFrames(&scene)) {
    ROS_WARN(
        "instrument %s has a frame in tf that another instrument has, too: give one a tf_prefix",
        name.c_str());
  }
  std::vector<std::string> names;
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    names.push_back(instrument.name);
  }
  Channels channels(scene.instruments.size());
  HapticLoop haptic(handle, scene, &channels);
  haptic.start();

  diagnostics.loading(scene.file);
  const std::unique_ptr<sim::Simulator> simulator = makeSimulator(scene, &diagnostics);
  diagnostics.setBlasWarning(checkBlas(*simulator));
  if (!params.initial_state.empty()) {
    io::restoreState(params.initial_state, simulator.get());
  }
  sayHello(*simulator);
  ros::Publisher records = handle.advertise<palpate::RunRecord>(kRunRecordTopic, 1, true);
  records.publish(record);

  InputFactory factory;
  Inputs inputs = factory.make(handle, *simulator, &channels);
  broadcastBases(*simulator);
  LiveCycle cycle(simulator.get(), &inputs, &channels);
  SimulationLoop simulation(&cycle, scene.rates.simulation, &channels.arrivals);
  diagnostics.running(&inputs, &haptic, names);
  std::vector<std::string> sources;
  for (const auto& input : inputs) sources.push_back(input->source());
  PublishingLoop publishing(handle, *simulator, params, sources, &channels, &diagnostics);

  // Requests wait for the simulation; joint positions must not wait for requests.
  ros::CallbackQueue requests;
  private_handle.setCallbackQueue(&requests);
  const StateFolder states(params.state_directory, ros::this_node::getName());
  Services services(private_handle, &cycle, &simulation, &states);
  CallbackThread request_thread("requests", &requests, false);
  CallbackThread input_thread("input", ros::getGlobalCallbackQueue(), true);
  diagnostics.setRealtime({sends_realtime, lockMemory()});

  if (params.save_state_at_end) cycle.keepStates();
  publishing.start();
  simulation.start();
  request_thread.start();
  input_thread.start();
  MasterWatch master(
      {private_handle.resolveName(kResetService), private_handle.resolveName(kSaveStateService)});
  master.start();
  Ending::wait();
  if (Crash::signal() != 0) ROS_FATAL("a thread crashed: %s", strsignal(Crash::signal()));

  haptic.finish();  // before all else: a hand holds it
  Ending::limit(kToEnd, 1);
  const Steady::time_point until =
      Steady::now() + seconds(params.save_state_at_end ? kToStep : 0.0);
  simulation.stop(until);
  if (params.save_state_at_end) saveAtEnd(&cycle, states, until);
  input_thread.stop();
  request_thread.stop();
  publishing.stop();
  return Ending::status();
}

}  // namespace
}  // namespace palpate::node

int main(int argc, char** argv) {
  palpate::start::restartWithSolverEnvironment(argv);
  palpate::start::keepFreedMemory();
  return palpate::node::runProgram(argc, argv, "palpate", palpate::node::aboutNode(),
                                   palpate::node::run);
}
