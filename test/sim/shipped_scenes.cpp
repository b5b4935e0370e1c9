// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/shipped_scenes.h"

#include <algorithm>

#include "palpate/formats/trajectory.h"
#include "palpate/io/replay.h"
#include "palpate/sim/simulator.h"
#include "start/shipped.h"

namespace palpate::sim::test {
namespace {

constexpr double kUntil = 1.3;  // of the trajectory [s]: tools have gone in

formats::Trajectory beginningOf(const std::string& file) {
  formats::Trajectory read = formats::readTrajectory(file);
  const auto end = std::upper_bound(read.t.begin(), read.t.end(), kUntil);
  read.t.erase(end, read.t.end());
  read.values.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(read.t.size()));
  return read;
}

}  // namespace

std::vector<std::string> shippedScenes() { return start::shippedScenes(); }

std::vector<std::uint64_t> hashesOf(const std::string& scene) {
  return hashesOfFile(start::sceneFile(scene), scene);
}

std::vector<std::uint64_t> hashesOfFile(const std::string& file, const std::string& scene) {
  const std::string motion = start::shippedTrajectory(start::sceneFile(scene));
  Simulator simulator(scene::readScene(file));
  io::Replay replay(&simulator, beginningOf(motion), motion);
  std::vector<std::uint64_t> hashes;
  while (replay.hasNext()) hashes.push_back(replay.next().report.state_hash);
  return hashes;
}

}  // namespace palpate::sim::test
