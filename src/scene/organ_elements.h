// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/surface_mesh.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// Surface of an organ in its frame, remeshed to organ.edge_length [m] for models with these
/// elements; the boundary of given tetrahedra is unchanged.
/// @param key key of the organ in the scene file, for messages.
/// @throws InputError for an unreadable surface, too many triangles, or half of the volume lost.
/// Losses above a tenth are added to `warnings`.
mesh::SurfaceMesh readOrganElements(const Scene& scene, const OrganConfig& organ,
                                    const std::string& key, std::vector<std::string>* warnings);

}  // namespace palpate::scene
