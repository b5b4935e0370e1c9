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

/// Tetrahedra of an organ of `scene` in its own frame, scaled to metres: read, or meshed from its
/// surface (through the user's cache). Adds what was repaired to `warnings`.
/// @throws InputError
mesh::TetMesh readOrganMesh(const Scene& scene, const OrganConfig& organ, const Progress& progress,
                            std::vector<std::string>* warnings);

/// Its closed surface, likewise: read and repaired, or the boundary of its tetrahedra.
/// @throws InputError
mesh::SurfaceMesh readOrganSurface(const OrganConfig& organ, const std::string& scene_file,
                                   std::vector<std::string>* warnings);

/// How the volume mesher is to fill the surface of an organ that has one.
/// @throws InputError if a file or an instrument that the scene names is not there or not right.
mesh::MeshingOptions meshingOptions(const Scene& scene, const OrganConfig& organ);

/// An organ of `scene` for the makers of models. Its functions refer to all that is given here, and
/// throw InputError.
tissue::OrganDescription describeOrgan(const Scene& scene, int index, const Progress& progress,
                                       std::vector<std::string>* warnings);

/// The tissue model of the organs at these places in the scene, which all name the same one.
/// `frictions`: of each organ of the scene with all that may touch it.
/// @throws InputError
std::unique_ptr<tissue::TissueModel> assembleModel(
    const Scene& scene, const std::vector<int>& organs,
    const contact::SampleSpacing& sample_spacing,
    const std::vector<contact::FrictionTable>& frictions, ThreadPool* pool,
    const Progress& progress, std::vector<std::string>* warnings);

}  // namespace palpate::scene
