// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/scene_parts.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <variant>

#include "anatomy_assembly.h"
#include "friction_tables.h"
#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/tissue/model_list.h"
#include "prescribed_contact_rules.h"

namespace palpate::scene {
namespace {

void checkNeedle(const Scene& scene, const std::string& key, const InstrumentConfig& config,
                 const instrument::Instrument& tool) {
  const NeedleConfig& needle = config.needle;
  if (needle.link.empty()) return;
  if (!(needle.puncture_force > 0.0)) {
    throw InputError(scene.file, key + ".puncture_force", std::to_string(needle.puncture_force),
                     "must be above 0: a needle needs some force to get in");
  }
  const int link = tool.linkIndex(needle.link);
  bool any = false;
  for (const instrument::CollisionBody& body : tool.bodies()) {
    if (body.link != link) continue;
    any = true;
    if (std::holds_alternative<instrument::Capsule>(body.geometry)) continue;
    if (std::holds_alternative<instrument::Cylinder>(body.geometry)) continue;
    any = false;
    break;
  }
  if (any) return;
  throw InputError(scene.file, key + ".link", needle.link,
                   "must be a link of " + config.urdf +
                       " whose collision shapes are cylinders; its links are " +
                       joinNames(tool.linkNames()));
}

void readInstruments(const Scene& scene, const Progress& progress, SceneParts* parts) {
  for (std::size_t i = 0; i < scene.instruments.size(); ++i) {
    const InstrumentConfig& config = scene.instruments[i];
    const std::string key = "instruments[" + std::to_string(i) + "]";
    std::string file;
    try {
      file = resolveResource(config.urdf, std::filesystem::path(scene.file).parent_path().string());
    } catch (const std::invalid_argument& error) {
      throw InputError(scene.file, key + ".urdf", config.urdf, error.what());
    }
    instrument::InstrumentOptions options;
    options.cylinder_as_capsule = config.cylinder_as_capsule;
    options.collision_meshes = config.collision_meshes;
    options.progress = progress;
    parts->instruments.push_back(instrument::readInstrument(file, options));
    const instrument::Instrument& tool = parts->instruments.back();
    for (const std::string& warning : tool.warnings()) parts->warnings.push_back(warning);
    for (const std::string& note : tool.notes()) {
      parts->notes.push_back("instrument " + config.name + ": " + note);
    }
    const int link = tool.linkIndex(config.control_frame);
    if (link < 0) {
      const std::string nearest = nearestName(config.control_frame, tool.linkNames());
      throw InputError(scene.file, key + ".control_frame", config.control_frame,
                       "must be a link of " + config.urdf +
                           (nearest.empty() ? "" : " (did you mean " + nearest + "?)") +
                           "; it has " + joinNames(tool.linkNames()));
    }
    parts->control_links.push_back(link);
    checkNeedle(scene, key + ".needle", config, tool);
  }
}

}  // namespace

std::vector<instrument::Instrument> readInstruments(const Scene& scene) {
  SceneParts parts;
  readInstruments(scene, {}, &parts);
  return std::move(parts.instruments);
}

namespace {

// Least sample spacing [m]; faces of the tissue detect thinner tools.
constexpr double kFinestSpacing = 5e-4;
// Ratio of spacings from which tools and anatomy have separate samples.
constexpr double kWorthwhile = 1.5;

// Spacing at which neither the thinnest tool nor the thinnest anatomy part fits between samples.
contact::SampleSpacing sampleSpacing(const Scene& scene, const SceneParts& parts) {
  if (scene.contact.sample_spacing > 0.0) return scene.contact.sample_spacing;
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  double tools = kNothing, bones = kNothing;
  const auto lower = [](const instrument::Geometry& geometry, double* spacing) {
    const double enough = std::max(0.5 * contact::inscribedRadius(geometry), kFinestSpacing);
    *spacing = std::min(*spacing, enough);
  };
  for (const instrument::Instrument& tool : parts.instruments) {
    for (const instrument::CollisionBody& body : tool.bodies()) lower(body.geometry, &tools);
  }
  for (const AnatomyPart& part : parts.anatomy) lower(part.geometry, &bones);
  const auto [finer, coarser] = std::minmax(tools, bones);
  if (finer == kNothing) return {};
  contact::SampleSpacing spacing(finer);
  if (coarser < kNothing && coarser > kWorthwhile * finer) {
    spacing.instruments = tools;
    spacing.anatomy = bones;
  }
  return spacing;
}

// Organs owned by the model of the organ `first`.
std::vector<int> organsOfModel(const Scene& scene, std::size_t first) {
  std::vector<int> organs = {static_cast<int>(first)};
  if (!tissue::ownsAllOrgans(scene.organs[first].model)) return organs;
  for (std::size_t i = first + 1; i < scene.organs.size(); ++i) {
    if (scene.organs[i].model == scene.organs[first].model) organs.push_back(static_cast<int>(i));
  }
  return organs;
}

std::string nameOf(const Scene& scene, int organ) {
  return "organ " + scene.organs[static_cast<std::size_t>(organ)].name;
}

void assembleModels(const Scene& scene, const Progress& progress, SceneParts* parts) {
  const contact::SampleSpacing spacing = sampleSpacing(scene, *parts);
  const std::vector<contact::FrictionTable> frictions = frictionTables(scene, *parts);
  parts->organs.resize(scene.organs.size(), {nullptr, 0});
  for (std::size_t i = 0; i < scene.organs.size(); ++i) {
    if (parts->organs[i].tissue) continue;
    ModelPart model{nullptr, organsOfModel(scene, i)};
    model.tissue = assembleModel(scene, model.organs, spacing, frictions, parts->pool.get(),
                                 progress, &parts->warnings);
    for (std::size_t k = 0; k < model.organs.size(); ++k) {
      parts->organs[static_cast<std::size_t>(model.organs[k])] = {model.tissue.get(),
                                                                  static_cast<int>(k)};
    }
    for (const std::string& note : model.tissue->notes()) {
      const bool one = model.organs.size() == 1;  // else the note names its organ
      parts->notes.push_back((one ? nameOf(scene, model.organs.front()) + ": " : "") + note);
    }
    parts->models.push_back(std::move(model));
  }
}

}  // namespace

SceneParts assembleScene(const Scene& scene, const Progress& progress) {
  SceneParts parts;
  if (scene.solver.threads > 1 || scene.solver.thread_for_tasks) {
    parts.pool = std::make_unique<ThreadPool>(scene.solver.threads, scene.solver.thread_for_tasks);
  }
  readInstruments(scene, progress, &parts);
  checkSegments(scene, parts);
  assembleAnatomy(scene, progress, &parts);
  assembleModels(scene, progress, &parts);
  warnOfOrgansInAnatomy(scene, &parts);
  return parts;
}

}  // namespace palpate::scene
