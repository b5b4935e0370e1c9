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
#include "options.h"
#include "palpate/base/error.h"
#include "palpate/haptics/swing.h"
#include "palpate/io/csv_writer.h"
#include "palpate/scene/hand_settings.h"
#include "palpate/sim/hand_loop.h"
#include "progress_line.h"

namespace palpate::cli {
namespace {

struct Options {
  std::string scene, out, grip = "light";
  std::optional<double> passivity, mass, damping, stiffness, grip_damping, resolution;
  double depth = 0.004, speed = 0.03, push = 0.0, duration = 5.0;
  double rate = 100.0, solve = 0.005, delay_in = 0.0, delay_out = 0.0, device_rate = 1000.0;
  bool hold = false, untold = false;
};

struct Grip {
  const char* name;
  haptics::HandSettings hand;
  double push;  // instead of a place to be [N]
};

// Mass of device and hand [kg], damping of the device, stiffness and damping of the grip.
constexpr Grip kGrips[] = {{"light", {0.10, 0.2, 100.0, 1.0, 5.5e-5, 0.0, 0.0}, 0.0},
                           {"normal", {0.15, 0.2, 300.0, 3.0, 5.5e-5, 0.0, 0.0}, 0.0},
                           {"firm", {0.30, 0.2, 1000.0, 10.0, 5.5e-5, 0.0, 0.0}, 0.0},
                           {"limp", {0.05, 0.2, 0.0, 0.0, 5.5e-5, 100.0, 1.0}, 0.5}};

std::vector<std::string> gripNames() {
  std::vector<std::string> names;
  for (const Grip& grip : kGrips) names.emplace_back(grip.name);
  return names;
}

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

sim::HandLoopSettings settingsFrom(const Options& o, const Grip& grip, const scene::Scene& scene) {
  const scene::InstrumentConfig& instrument = scene.instruments[0];
  sim::HandLoopSettings s;
  s.hand = grip.hand;
  s.hand.mass = o.mass.value_or(s.hand.mass);
  s.hand.device_damping = o.damping.value_or(s.hand.device_damping);
  s.hand.grip_stiffness = o.stiffness.value_or(s.hand.grip_stiffness);
  s.hand.grip_damping = o.grip_damping.value_or(s.hand.grip_damping);
  s.hand.resolution = o.resolution.value_or(s.hand.resolution);
  s.filter = scene::filterSettings(scene, instrument);
  s.filter.smoothing = o.hold ? 0.5 / o.rate : 0.0;
  s.cycle = 1.0 / o.rate;
  s.solve = o.solve;
  s.delay_in = o.delay_in;
  s.delay_out = o.delay_out;
  s.local_model = !o.hold;
  s.passivity = scene.haptics;
  s.passivity.max_damping = o.passivity.value_or(scene.haptics.max_damping);
  s.coupling = instrument.proxy;
  s.device_rate = o.device_rate;
  s.told = instrument.device;
  if (o.untold) return s;
  s.told.damping = s.hand.device_damping;
  s.told.delay = o.delay_in + o.delay_out;
  s.told.rate = o.device_rate;
  s.told.mass = std::min(s.told.mass, s.hand.mass);
  return s;
}

void checkNumbers(const Options& o) {
  requirePositive("--rate", o.rate);
  requirePositive("--duration", o.duration);
  requirePositive("--speed", o.speed);
  requirePositive("--device-rate", o.device_rate);
  requirePositive("--mass", o.mass.value_or(1.0));
  requireNotNegative("--depth", o.depth);
  requireNotNegative("--push", o.push);
  requireNotNegative("--solve", o.solve);
  requireNotNegative("--delay-in", o.delay_in);
  requireNotNegative("--delay-out", o.delay_out);
  requireNotNegative("--damping", o.damping.value_or(0.0));
  requireNotNegative("--grip-stiffness", o.stiffness.value_or(0.0));
  requireNotNegative("--grip-damping", o.grip_damping.value_or(0.0));
  requireNotNegative("--resolution", o.resolution.value_or(0.0));
  requireNotNegative("--passivity", o.passivity.value_or(0.0));
}

int hand(const Options& o) {
  checkNumbers(o);
  if (!o.out.empty()) requireWritable("--out", o.out, {".csv"});
  const Grip& grip = *std::find_if(std::begin(kGrips), std::end(kGrips),
                                   [&](const Grip& g) { return g.name == o.grip; });
  scene::Scene scene = scene::readScene(o.scene);
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

  sim::HandLoop loop(&simulator, 0, start, settingsFrom(o, grip, scene));
  std::optional<io::CsvWriter> csv;
  if (!o.out.empty()) {
    csv.emplace(o.out, std::vector<std::string>{"t", "meant_z", "x", "y", "z", "fx", "fy", "fz",
                                                "solved_fx", "solved_fy", "solved_fz"});
  }
  const double push = o.push + grip.push, last = std::max(0.5 * o.duration, o.duration - 2.0);
  haptics::Swing swing;
  double least = 1e9, most = 0.0, deepest = 0.0, force = 0.0, stiffness = 0.0, tissue = 0.0;
  for (double t = 0.0; t < o.duration;) {
    const double way = std::min(o.speed * t, kAbove + o.depth);
    const bool moves = way < kAbove + o.depth;
    sim::HandIntent intent;
    intent.position.z() = -way;
    intent.velocity.z() = moves ? -o.speed : 0.0;
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
      "energy out of the port, at most: %.4g mJ, of which %.4g mJ were taken back\n",
      o.duration - last, 1e3 * swing.length(), 1e3 * swing.range(), least, most, 1e3 * deepest,
      tissue, stiffness, 1e3 * loop.passivity().largestOut(), 1e3 * loop.passivity().dissipated());
  return kOk;
}

}  // namespace

void addHand(CLI::App& app, Action& action) {
  Command command(app, "hand",
                  "Have a simulated hand hold the tool of a scene by a simulated device, press it "
                  "down and keep it there");
  const auto options = std::make_shared<Options>();
  command.option("scene", &options->scene, "Scene file with one instrument").required();
  command.option("--grip", &options->grip, "Of the hand").oneOf(gripNames());
  command.option("--mass", &options->mass, "Of device and hand [kg], instead of the grip's");
  command.option("--damping", &options->damping, "Of the device [N s/m]");
  command.option("--grip-stiffness", &options->stiffness, "[N/m]");
  command.option("--grip-damping", &options->grip_damping, "[N s/m]");
  command.option("--resolution", &options->resolution, "Of the device's encoders [m]");
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
  command.flag("--hold", &options->hold, "Hold the last wrench: no local model");
  command.flag("--untold", &options->untold,
               "The program knows of the device what the scene says, not what is given here");
  command.option("--out", &options->out, "CSV of every tick");
  command.onUse([options, &action] { action = [options] { return hand(*options); }; });
}

}  // namespace palpate::cli
