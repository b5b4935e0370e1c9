// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/mesh/volume_mesher.h"
#include "palpate/scene/scene.h"
#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::scene {

using Progress = std::function<void(const std::string& what, double fraction)>;

/// Tetrahedra of an organ of `scene` in its own frame [m]: read, or meshed from its surface by the
/// user's cache. Adds repairs to `warnings`.
/// @throws InputError
mesh::TetMesh readOrganMesh(const Scene& scene, const OrganConfig& organ, const Progress& progress,
                            std::vector<std::string>* warnings);

/// Closed surface of the organ in its own frame [m]: read and repaired, or the tetrahedra's
/// boundary.
/// @throws InputError
mesh::SurfaceMesh readOrganSurface(const OrganConfig& organ, const std::string& scene_file,
                                   std::vector<std::string>* warnings);

/// Settings of the volume mesher for an organ with a surface.
/// @throws InputError for a missing or invalid file or instrument.
mesh::MeshingOptions meshingOptions(const Scene& scene, const OrganConfig& organ);

/// Description of an organ of `scene` for makers of models. Its functions refer to the arguments
/// and throw InputError.
tissue::OrganDescription describeOrgan(const Scene& scene, int index, const Progress& progress,
                                       std::vector<std::string>* warnings);

/// Makes the tissue model of the organs with these scene indices. `frictions`: of each organ of the
/// scene.
/// @pre The organs name the same model.
/// @throws InputError
std::unique_ptr<tissue::TissueModel> assembleModel(
    const Scene& scene, const std::vector<int>& organs,
    const contact::SampleSpacing& sample_spacing,
    const std::vector<contact::FrictionTable>& frictions, ThreadPool* pool,
    const Progress& progress, std::vector<std::string>* warnings);

}  // namespace palpate::scene
