// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/instrument/instrument.h"
#include "palpate/scene/organ_assembly.h"
#include "palpate/scene/scene.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::scene {

/// A tissue model and the organs that it owns, by their places in the scene.
struct ModelPart {
  std::unique_ptr<tissue::TissueModel> tissue;
  std::vector<int> organs;
};

/// Where an organ of the scene is.
struct OrganHandle {
  tissue::TissueModel* tissue;
  int organ;  ///< Of the model's.

  tissue::SurfaceState surfaceState() const { return tissue->surfaceState(organ); }
};

/// Something rigid that never moves.
struct AnatomyPart {
  std::string name;
  instrument::Geometry geometry;
  Pose X_WG;                  ///< The shape's frame, in the middle of its box, to world.
  double stiffness;           ///< Of what a tool feels of it [N/m].
  mesh::SurfaceMesh surface;  ///< As it was read, for pictures; in the shape's frame [m].
};

/// What a scene's files hold.
struct SceneParts {
  std::unique_ptr<ThreadPool> pool;  // first: outlives the models
  std::vector<instrument::Instrument> instruments;
  std::vector<int> control_links;    ///< Link index of each instrument's control frame.
  std::vector<AnatomyPart> anatomy;  ///< In the scene's order.
  std::vector<ModelPart> models;     ///< In the order of their first organs.
  std::vector<OrganHandle> organs;   ///< In the scene's order.
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  ///< What was decided while loading, with the name of whom.
};

/// The instruments alone, without the organs: for who moves them.
/// @throws InputError
std::vector<instrument::Instrument> readInstruments(const Scene& scene);

/// @throws InputError
SceneParts assembleScene(const Scene& scene, const Progress& progress);

}  // namespace palpate::scene
