// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/scene/scene.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::scene {

using LoadProgress = std::function<void(const std::string& what, double fraction)>;

/// Tetrahedra of an organ in its own frame, scaled to metres: read, or meshed from its surface
/// (through the user's cache). Adds what was repaired to `warnings`.
/// @throws InputError
mesh::TetMesh loadOrganMesh(const OrganConfig& organ, const std::string& scene_file,
                            const LoadProgress& progress, std::vector<std::string>* warnings);

/// The organ's tissue in world, at rest, held by its supports. `index` is its place in the scene.
/// @throws InputError
std::unique_ptr<tissue::TissueModel> loadTissue(const Scene& scene, std::size_t index,
                                                double sample_spacing, ThreadPool* pool,
                                                const LoadProgress& progress,
                                                std::vector<std::string>* warnings);

}  // namespace palpate::scene
