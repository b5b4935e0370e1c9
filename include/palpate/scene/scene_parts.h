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

/// A tissue model with the scene indices of its organs.
struct ModelPart {
  std::unique_ptr<tissue::TissueModel> tissue;
  std::vector<int> organs;
};

/// Model and index of an organ of the scene.
struct OrganHandle {
  tissue::TissueModel* tissue;
  int organ;  ///< Index among the model's organs.

  tissue::SurfaceState surfaceState() const { return tissue->surfaceState(organ); }
};

/// A rigid, fixed part of the anatomy.
struct AnatomyPart {
  std::string name;
  instrument::Geometry geometry;
  Pose X_WG;         ///< Pose of the shape's frame, in the middle of its bounding box, world.
  double stiffness;  ///< Contact stiffness for tools [N/m].
  mesh::SurfaceMesh surface;  ///< Surface for display, in the shape's frame [m].
};

/// Loaded contents of a scene's files.
struct SceneParts {
  std::unique_ptr<ThreadPool> pool;  // first, since it must outlive the models
  std::vector<instrument::Instrument> instruments;
  std::vector<int> control_links;    ///< Link index of each instrument's control frame.
  std::vector<AnatomyPart> anatomy;  ///< In the scene's order.
  std::vector<ModelPart> models;     ///< In the order of their first organs.
  std::vector<OrganHandle> organs;   ///< In the scene's order.
  std::vector<std::string> warnings;
  std::vector<std::string>
      notes;  ///< Decisions of loading, with the names of organs or instruments.
};

/// Loads only the instruments.
/// @throws InputError
std::vector<instrument::Instrument> readInstruments(const Scene& scene);

/// @throws InputError
SceneParts assembleScene(const Scene& scene, const Progress& progress);

}  // namespace palpate::scene
