// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/shipped_scenes.h"

#include <algorithm>
#include <filesystem>

#include "palpate/formats/trajectory.h"
#include "palpate/io/replay.h"
#include "palpate/sim/simulator.h"
#include "support/source_folder.h"

namespace palpate::sim::test {
namespace {

namespace fs = std::filesystem;
constexpr double kUntil = 1.3;       // of the trajectory [s]: tools have gone in
constexpr double kWithoutOne = 0.2;  // at rest, of scenes without a trajectory

std::string configFolder() { return palpate::test::sourceFolder() + "/config/"; }

// Its own, or that of the scene whose name begins alike, as scripts/demo.sh takes it; else all
// joints stay at zero.
formats::Trajectory trajectoryOf(const std::string& scene, const Simulator& simulator) {
  const std::string first = scene.substr(0, scene.find('_'));
  for (const std::string& name : {scene, first == "slab" ? std::string("slab_probe") : scene}) {
    const std::string file = configFolder() + "trajectories/" + name + ".csv";
    if (!fs::exists(file)) continue;
    formats::Trajectory read = formats::readTrajectory(file);
    const auto end = std::upper_bound(read.t.begin(), read.t.end(), kUntil);
    read.t.erase(end, read.t.end());
    read.values.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(read.t.size()));
    return read;
  }
  formats::Trajectory still;
  for (std::size_t i = 0; i < simulator.scene().instruments.size(); ++i) {
    for (const std::string& joint : simulator.instrument(static_cast<int>(i)).jointNames()) {
      still.columns.push_back(simulator.scene().instruments[i].name + "/" + joint);
    }
  }
  for (double t = 0.0; t < kWithoutOne; t += simulator.scene().solver.step) still.t.push_back(t);
  still.values.setZero(static_cast<Eigen::Index>(still.columns.size()),
                       static_cast<Eigen::Index>(still.t.size()));
  return still;
}

}  // namespace

std::vector<std::string> shippedScenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(configFolder() + "scenes")) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::uint64_t> hashesOf(const std::string& scene) {
  return hashesOfFile(configFolder() + "scenes/" + scene + ".yaml", scene);
}

std::vector<std::uint64_t> hashesOfFile(const std::string& file, const std::string& scene) {
  Simulator simulator(scene::readScene(file));
  io::Replay replay(&simulator, trajectoryOf(scene, simulator), scene);
  std::vector<std::uint64_t> hashes;
  while (replay.hasNext()) hashes.push_back(replay.next().report.state_hash);
  return hashes;
}

}  // namespace palpate::sim::test
