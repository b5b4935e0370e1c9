// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/loaded_scene.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/contact/signed_distance.h"

namespace palpate::scene {
namespace {

void loadInstruments(const Scene& scene, LoadedScene* loaded) {
  for (std::size_t i = 0; i < scene.instruments.size(); ++i) {
    const InstrumentConfig& config = scene.instruments[i];
    const std::string key = "instruments[" + std::to_string(i) + "]";
    std::string file;
    try {
      file = resolveResource(config.urdf, std::filesystem::path(scene.file).parent_path().string());
    } catch (const std::invalid_argument& error) {
      throw InputError(scene.file, key + ".urdf", config.urdf, error.what());
    }
    instrument::LoadOptions options;
    options.cylinder_as_capsule = config.cylinder_as_capsule;
    loaded->instruments.push_back(instrument::loadInstrument(file, options));
    const instrument::Instrument& tool = loaded->instruments.back();
    for (const std::string& warning : tool.warnings()) loaded->warnings.push_back(warning);
    const int link = tool.linkIndex(config.control_frame);
    if (link < 0) {
      const std::string nearest = nearestName(config.control_frame, tool.linkNames());
      throw InputError(scene.file, key + ".control_frame", config.control_frame,
                       "must be a link of " + config.urdf +
                           (nearest.empty() ? "" : " (did you mean " + nearest + "?)") +
                           "; it has " + joinNames(tool.linkNames()));
    }
    loaded->control_links.push_back(link);
  }
}

// Samples so close that the thinnest tool cannot push its way between them.
double sampleSpacing(const Scene& scene, const LoadedScene& loaded) {
  if (scene.contact.sample_spacing > 0.0) return scene.contact.sample_spacing;
  double spacing = std::numeric_limits<double>::infinity();
  for (const instrument::Instrument& tool : loaded.instruments) {
    for (const instrument::CollisionBody& body : tool.bodies()) {
      spacing = std::min(spacing, 0.5 * contact::inscribedRadius(body.geometry));
    }
  }
  return std::isfinite(spacing) ? spacing : 0.0;
}

}  // namespace

LoadedScene loadScene(const Scene& scene, const LoadProgress& progress) {
  LoadedScene loaded;
  if (scene.solver.threads > 1) loaded.pool = std::make_unique<ThreadPool>(scene.solver.threads);
  loadInstruments(scene, &loaded);
  const double spacing = sampleSpacing(scene, loaded);
  for (std::size_t i = 0; i < scene.organs.size(); ++i) {
    loaded.tissues.push_back(
        loadTissue(scene, i, spacing, loaded.pool.get(), progress, &loaded.warnings));
    for (const std::string& note : loaded.tissues.back()->notes()) {
      loaded.notes.push_back("organ " + scene.organs[i].name + ": " + note);
    }
  }
  return loaded;
}

}  // namespace palpate::scene
