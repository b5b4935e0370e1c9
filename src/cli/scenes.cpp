// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "command.h"
#include "commands.h"
#include "palpate/scene/scene.h"
#include "shipped.h"

namespace palpate::cli {
namespace {

std::string nameOfFile(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

// Name, share of real time that cycles at their rate make, and trajectory of each.
int listScenes() {
  std::printf("%-22s %9s  %s\n", "scene", "real time", "trajectory");
  for (const std::string& name : start::shippedScenes()) {
    const std::string file = start::sceneFile(name);
    const scene::Scene scene = scene::readScene(file);
    std::printf("%-22s %9.3g  %s\n", name.c_str(), scene.rates.simulation * scene.solver.step,
                nameOfFile(start::shippedTrajectory(file)).c_str());
  }
  return kOk;
}

int showScene(const std::string& name) {
  const std::string file = start::sceneFile(name);
  std::printf("scene %s\ntrajectory %s\n", file.c_str(), start::shippedTrajectory(file).c_str());
  return kOk;
}

}  // namespace

void addScenes(CLI::App& app, Action& action) {
  Command command(app, "scenes", "List the scenes that come with palpate, or say where one is");
  const auto name = std::make_shared<std::string>();
  command.option("name", name.get(), "Of a scene; its file and that of its trajectory are printed");
  command.onUse([name, &action] {
    action = [name] { return name->empty() ? listScenes() : showScene(*name); };
  });
}

}  // namespace palpate::cli
