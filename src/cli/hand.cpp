// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "commands.h"
#include "hand_options.h"
#include "options.h"
#include "palpate/base/error.h"
#include "palpate/haptics/swing.h"
#include "palpate/io/csv_writer.h"
#include "palpate/sim/hand_loop.h"
#include "palpate/sim/hand_motion.h"
#include "progress_line.h"
#include "shipped.h"

namespace palpate::cli {
namespace {

sim::LinkPoses shifted(const sim::LinkPoses& links, double up) {
  sim::LinkPoses at = links;
  for (Pose& X : at) X.pretranslate(Vec3(0.0, 0.0, up));
  return at;
}

// How far the tool can go down from `links` until it touches [m].
double wayToTouch(const sim::Simulator& simulator, const sim::LinkPoses& links) {
  const scene::Scene& scene = simulator.scene();
  const std::string key = "instruments." + scene.instruments[0].name + ".base";
  constexpr double kLook = 1e-3, kFarthest = 1.0, kFine = 1e-5;  // [m]
  if (!simulator.isFree(0, links)) {
    throw InputError(scene.file, key, "",
                     "must have the tool clear of tissue with all joints zero");
  }
  double free = 0.0, touching = kLook;
  while (simulator.isFree(0, shifted(links, -touching))) {
    free = touching;
    touching += kLook;
    if (touching > kFarthest) {
      throw InputError(scene.file, key, "", "must have tissue less than 1 m below the tool");
    }
  }
  while (touching - free > kFine) {
    const double middle = 0.5 * (free + touching);
    (simulator.isFree(0, shifted(links, -middle)) ? free : touching) = middle;
  }
  return free;
}

int hand(const HandOptions& o) {
  checkNumbers(o);
  if (!o.out.empty()) requireWritable("--out", o.out, {".csv"});
  scene::Scene scene = scene::readScene(start::sceneFile(o.scene));
  if (scene.instruments.size() != 1) {
    throw InputError(o.scene, "instruments", std::to_string(scene.instruments.size()),
                     "must be one here");
  }
  scene.instruments[0].proxy.active = true;
  start::ProgressLine line;
  sim::Simulator simulator(
      scene, [&](const std::string& what, double fraction) { line.show(what, fraction); });
  constexpr double kAbove = 0.005;  // [m]
  const Eigen::Index joints =
      static_cast<Eigen::Index>(simulator.instrument(0).jointNames().size());
  const sim::LinkPoses zero = simulator.linkPoses(0, Eigen::VectorXd::Zero(joints));
  const sim::LinkPoses start = shifted(zero, kAbove - wayToTouch(simulator, zero));

  sim::HandLoop loop(&simulator, 0, start, settingsFrom(o, scene));
  std::optional<io::CsvWriter> csv;
  if (!o.out.empty()) {
    csv.emplace(o.out, std::vector<std::string>{"t", "meant_z", "x", "y", "z", "fx", "fy", "fz",
                                                "solved_fx", "solved_fy", "solved_fz"});
  }
  sim::HandMotion motion({o.motion, kAbove, o.depth, o.speed});
  const double push = o.push + gripPush(o), last = std::max(0.5 * o.duration, o.duration - 2.0);
  haptics::Swing swing;
  double least = 1e9, most = 0.0, deepest = 0.0, force = 0.0, stiffness = 0.0, tissue = 0.0;
  for (double t = 0.0; t < o.duration;) {
    sim::HandIntent intent = motion.at(t);
    intent.push.z() = -push;
    const sim::HandTick& tick = loop.tick(intent);
    t = tick.time;
    force = tick.force.norm();
    deepest = std::max(deepest, -tick.position.z() - kAbove);
    if (t > last) {
      swing.add(tick.position);
      least = std::min(least, force);
      most = std::max(most, force);
      stiffness = std::max(stiffness, tick.stiffness);
      tissue = std::max(tissue, tick.tissue_stiffness);
    }
    if (csv) {
      *csv << t << tick.meant.z();
      for (const Vec3& v : {tick.position, tick.force, tick.solved})
        *csv << v.x() << v.y() << v.z();
      csv->endRow();
    }
    line.show("holding " + o.scene, t / o.duration);
  }
  line.finish();
  if (csv) csv->close();
  std::printf(
      "swing of the last %.3g s: %.4g mm (with creep %.4g mm), force %.4g to %.4g N; deepest %.4g "
      "mm\n"
      "stiffness of the tissue %.4g N/m, as rendered %.4g N/m\n"
      "energy out of the port, at most: %.4g mJ; taken back by damping: %.4g mJ\n",
      o.duration - last, 1e3 * swing.length(), 1e3 * swing.range(), least, most, 1e3 * deepest,
      tissue, stiffness, 1e3 * loop.passivity().largestOut(), 1e3 * loop.passivity().dissipated());
  return kOk;
}

}  // namespace

void addHand(CLI::App& app, Action& action) {
  Command command(app, "hand",
                  "Have a simulated hand hold the tool of a scene by a simulated device, press it "
                  "down and keep it there");
  const auto options = std::make_shared<HandOptions>();
  command
      .option("scene", &options->scene,
              "Scene file with one instrument, or name of a shipped scene")
      .required();
  command.option("--grip", &options->grip, "Of the hand").oneOf(gripNames());
  command.option("--mass", &options->mass, "Of device and hand [kg], instead of the grip's");
  command.option("--damping", &options->damping, "Of the device [N s/m]");
  command.option("--grip-stiffness", &options->stiffness, "[N/m]");
  command.option("--grip-damping", &options->grip_damping, "[N s/m]");
  command.option("--resolution", &options->resolution, "Of the device's encoders [m]");
  command.option("--motion", &options->motion, "What the hand means to do")
      .oneOf(sim::HandMotion::names());
  command.option("--depth", &options->depth, "Where the hand means to be, below the surface [m]");
  command.option("--speed", &options->speed, "On the way there [m/s]");
  command.option("--push", &options->push, "Weight of a hand that means to be nowhere [N]");
  command.option("--duration", &options->duration, "[s]");
  command.option("--rate", &options->rate, "Of the simulation [Hz]");
  command.option("--solve", &options->solve, "From a cycle's input to its wrench [s]");
  command.option("--delay-in", &options->delay_in, "From the device to the program [s]");
  command.option("--delay-out", &options->delay_out, "And back [s]");
  command.option("--device-rate", &options->device_rate,
                 "The device reports poses and takes forces so often [Hz]");
  command.option("--passivity", &options->passivity,
                 "Damping that the passivity controller may add [N s/m]; 0: none");
  command.flag("--prescribed", &options->prescribed,
               "The hand goes where it means to, whatever it feels");
  command.flag("--late", &options->late,
               "Force for where the hand was heard to be, however stiff: no lead, no spring");
  command.flag("--hold", &options->hold, "Hold the last wrench: no local model, and --late");
  command.flag("--untold", &options->untold,
               "The program knows of the device what the scene says, not what is given here");
  command.option("--out", &options->out, "CSV of every tick");
  command.onUse([options, &action] { action = [options] { return hand(*options); }; });
}

}  // namespace palpate::cli
