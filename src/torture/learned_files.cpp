// SPDX-License-Identifier: GPL-3.0-or-later
#include "learned_files.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/enrichment/database_folder.h"
#include "palpate/enrichment/surrogate_file.h"
#include "palpate/enrichment/surrogate_training.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/scene/organ_assembly.h"
#include "palpate/scene/pressed_organ.h"

namespace palpate::torture {
namespace {

// Few, since each scene trains its own; just enough for training.
constexpr int kSamples = 16, kTriangles = 80;
constexpr double kDeep = 0.03;  // largest press over the displacement at a strain of one

bool learns(const std::string& model) { return model == "enriched" || model == "neural"; }

enrichment::DatabasePlan planOf(const TortureOrgan& organ) {
  enrichment::DatabasePlan plan;
  plan.samples = kSamples;
  const auto surface = static_cast<int>(mesh::boundaryTriangles(organ.mesh.tets).cols());
  plan.triangles = std::min(kTriangles, surface);
  plan.splits = 1;
  const double patch = 0.3 * organ.size.minCoeff();
  plan.patch = patch;
  plan.edge_length = patch;
  plan.press.force = kDeep * organ.young * patch * patch;
  return plan;
}

}  // namespace

std::string learnedText(const TortureOrgan& organ) {
  if (organ.model == "neural") return "    neural: {file: " + organ.name + ".net}\n";
  if (organ.model == "enriched") return "    enriched: {database: " + organ.name + "_presses}\n";
  return "";
}

void writeLearned(const TortureScene& scene, const std::string& scene_file,
                  const std::string& folder) {
  const auto wanted = [](const TortureOrgan& organ) { return learns(organ.model); };
  if (std::none_of(scene.organs.begin(), scene.organs.end(), wanted)) return;
  scene::Scene read = scene::readScene(scene_file);
  std::vector<std::string> warnings;
  const scene::Progress none;
  for (std::size_t i = 0; i < scene.organs.size(); ++i) {
    const TortureOrgan& organ = scene.organs[i];
    if (!learns(organ.model)) continue;
    read.organs[i].neural.file.clear();  // the file does not exist yet
    const int index = static_cast<int>(i);
    const scene::PressedOrgan pressed = scene::describePresses(
        read, index, scene::describeOrgan(read, index, none, &warnings), planOf(organ), none);
    const std::string presses = folder + "/" + organ.name + "_presses";
    enrichment::SampleMaker(presses, pressed.surfaces, kSamples).run(1, {});
    if (organ.model != "neural") continue;
    enrichment::TrainingSettings training;
    training.held_out = 0.0;
    training.modes = 4;
    try {
      enrichment::writeSurrogate(
          folder + "/" + organ.name + ".net",
          enrichment::trainSurrogate(enrichment::readDatabase(presses), training));
    } catch (const std::invalid_argument& error) {
      throw InputError(presses, "", "", error.what());
    }
  }
}

}  // namespace palpate::torture
