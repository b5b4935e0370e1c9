// SPDX-License-Identifier: GPL-3.0-or-later
#include "params.h"

#include <ros/package.h>

#include <cmath>
#include <cstdlib>
#include <iterator>

#include "palpate/base/error.h"
#include "param_fields.h"

namespace palpate::node {

std::string rosHome() {
  if (const char* home = std::getenv("ROS_HOME")) return home;
  const char* home = std::getenv("HOME");
  return std::string(home ? home : ".") + "/.ros";
}

NodeParams readParams(const ros::NodeHandle& handle) {
  NodeParams p;
  const std::string where = "parameters of " + handle.getNamespace();
  if (!handle.getParam(kSceneParam, p.scene) || p.scene.empty()) {
    throw InputError(where, kSceneParam, p.scene,
                     "must be a scene file or the name of a shipped scene (liver_palpation)");
  }
  p.state_directory = handle.param(kStateDirectoryParam, p.state_directory);
  p.initial_state = handle.param(kInitialStateParam, p.initial_state);
  p.arrow_scale = handle.param(kArrowScaleParam, p.arrow_scale);
  if (!std::isfinite(p.arrow_scale) || p.arrow_scale <= 0.0) {
    throw InputError(where, kArrowScaleParam, std::to_string(p.arrow_scale),
                     "must be finite and > 0 [m/N]");
  }
  ParamFields fields(handle);
  fields.apply(kCutawaySection, p.cutaway);
  fields.check();
  return p;
}

std::string sceneFile(const std::string& name) {
  constexpr char kPackage[] = "package://";
  if (name.rfind(kPackage, 0) == 0) {
    const std::string rest = name.substr(sizeof(kPackage) - 1);
    const std::size_t slash = rest.find('/');
    const std::string path = ros::package::getPath(rest.substr(0, slash));
    return path.empty() || slash == std::string::npos ? name : path + rest.substr(slash);
  }
  if (name.find('/') != std::string::npos || name.find('.') != std::string::npos) return name;
  return ros::package::getPath("palpate") + "/config/scenes/" + name + ".yaml";
}

scene::Scene readScene(const std::string& file, const ros::NodeHandle& handle) {
  scene::Scene scene = scene::readScene(file);
  ParamFields fields(handle);
  fields.apply(kSceneSections[0], scene.contact);
  fields.apply(kSceneSections[1], scene.solver);
  fields.apply(kSceneSections[2], scene.rates);
  fields.apply(kSceneSections[3], scene.haptics);
  for (scene::InstrumentConfig& instrument : scene.instruments) {
    fields.apply(std::string(kInstrumentsSection) + "/" + instrument.name, instrument);
  }
  std::vector<std::string> known(std::begin(kNodeParams), std::end(kNodeParams));
  known.emplace_back(kCutawaySection);
  known.insert(known.end(), std::begin(kSceneSections), std::end(kSceneSections));
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    known.push_back(std::string(kInstrumentsSection) + "/" + instrument.name);
  }
  known.insert(known.end(), std::begin(kLibraryParams), std::end(kLibraryParams));
  fields.refuseOthers(known);
  fields.check();
  return scene;
}

}  // namespace palpate::node
