// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_frames.h"

#include <filesystem>
#include <map>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/instrument/description.h"
#include "ros/messages/topics.h"
#include "tf_lookup.h"

namespace palpate::node {
namespace {

std::string urdfFile(const scene::Scene& scene, const scene::InstrumentConfig& instrument) {
  return resolveResource(instrument.urdf, std::filesystem::path(scene.file).parent_path().string());
}

/// "" for an instrument that loading will refuse.
std::vector<std::string> linksOf(const scene::Scene& scene,
                                 const scene::InstrumentConfig& instrument) {
  try {
    return instrument::readLinkNames(urdfFile(scene, instrument));
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

std::vector<std::string> separateFrames(scene::Scene* scene) {
  std::vector<std::vector<std::string>> links;
  for (const scene::InstrumentConfig& instrument : scene->instruments) {
    links.push_back(linksOf(*scene, instrument));
  }
  // Each round makes a name longer by that of its instrument; names of instruments are unique.
  std::vector<std::string> ambiguous;
  for (std::size_t round = 0; round <= scene->instruments.size(); ++round) {
    std::map<std::string, int> owners;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const scene::InstrumentConfig& instrument = scene->instruments[i];
      const bool placed = !instrument.base.pose().isApprox(Pose::Identity());
      for (const std::string& link : links[i]) {
        const std::string frame = instrument.tf_prefix + link;
        owners[frame] += frame == kWorldFrame && placed && instrument.input == "joints" ? 2 : 1;
      }
    }
    ambiguous.clear();
    bool changed = false;
    for (std::size_t i = 0; i < links.size(); ++i) {
      scene::InstrumentConfig& instrument = scene->instruments[i];
      bool shared = false;
      for (const std::string& link : links[i]) shared |= owners[instrument.tf_prefix + link] > 1;
      if (!shared) continue;
      ambiguous.push_back(instrument.name);
      if (instrument.input != "joints") continue;
      instrument.tf_prefix = instrument.name + "/" + instrument.tf_prefix;
      changed = true;
    }
    if (!changed) break;
  }
  return ambiguous;
}

std::string robotDescription(const sim::Simulator& simulator, int i) {
  const scene::Scene& scene = simulator.scene();
  const scene::InstrumentConfig& config = scene.instruments[static_cast<std::size_t>(i)];
  instrument::DescriptionSettings settings;
  settings.link_prefix = config.tf_prefix;
  if (config.input == "tf") {
    for (const std::string& frame : TfLookup(simulator.instrument(i), config).frames()) {
      settings.links.push_back(frame.substr(config.tf_prefix.size()));
    }
  }
  return instrument::describeUrdf(urdfFile(scene, config), settings);
}

std::string rootFrame(const sim::Simulator& simulator, int i) {
  return simulator.scene().instruments[static_cast<std::size_t>(i)].tf_prefix +
         simulator.instrument(i).linkNames().front();
}

}  // namespace palpate::node
