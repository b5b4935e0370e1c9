// SPDX-License-Identifier: GPL-3.0-or-later
#include "params.h"

#include <climits>
#include <cstdlib>
#include <iterator>

#include "palpate/base/error.h"
#include "ros/program/param_fields.h"

namespace palpate::node {

std::string rosHome() {
  if (const char* home = std::getenv("ROS_HOME")) return home;
  const char* home = std::getenv("HOME");
  return std::string(home ? home : ".") + "/.ros";
}

void describe(keys::FieldVisitor& v, NodeParams& p) {
  const auto path = [&](const char* key, const char* doc, std::string& value) {
    v.text({key, "", doc}, value);
    v.rule(value.size() < PATH_MAX, key, "is longer than a path may be");
    if (value.size() >= PATH_MAX) value.clear();
  };
  path(kSceneParam, "A scene file, or the name of a shipped scene.", p.scene);
  path(kInitialStateParam, "A file of ~save_state to start from.", p.initial_state);
  path(kStateDirectoryParam, "Where ~save_state writes.", p.state_directory);
  v.flag({kSaveAtEndParam, "", "The state at the end is written there, too."}, p.save_state_at_end);
  v.number({kArrowScaleParam, "m/N", "Length of the wrench arrow; 0: fits the scene."},
           p.arrow_scale, keys::Range::closed(0.0));
  v.flag(
      {kPublishLinksParam, "", "Instruments' links are published in tf, and their descriptions."},
      p.publish_links);
  v.rule(!p.scene.empty(), kSceneParam,
         "must be a scene file or the name of a shipped scene (liver_palpation)");
  v.rule(!p.state_directory.empty(), kStateDirectoryParam, "must be a folder");
}

NodeParams readParams(const ParamTree& params) {
  NodeParams p;
  ParamFields fields(params);
  fields.applyHere(p);
  fields.apply(kCutawaySection, p.cutaway);
  fields.check();
  return p;
}

scene::Scene readScene(const std::string& file, const ParamTree& params) {
  scene::Scene scene = scene::readScene(file);
  ParamFields fields(params);
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
