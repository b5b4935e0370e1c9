// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/surface_mesh.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// The surface of an organ in triangles of one edge length, that of organ.edge_length [m], for
/// models whose elements they are; that of its tetrahedra as it is. In the organ's frame.
/// @param key of the organ in the scene file, for messages.
/// @throws InputError where the surface cannot be read, or the triangles would be too many, or so
/// large that half of the organ's volume is lost; from a tenth on that is told in `warnings`.
mesh::SurfaceMesh readOrganElements(const Scene& scene, const OrganConfig& organ,
                                    const std::string& key, std::vector<std::string>* warnings);

}  // namespace palpate::scene
