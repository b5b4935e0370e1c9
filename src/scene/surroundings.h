// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/mesh/tet_mesh.h"
#include "palpate/scene/scene.h"
#include "palpate/tissue/surroundings.h"

namespace palpate::scene {

/// Boundary conditions of an organ on its `mesh`, in the organ's frame. `key`: key of the organ.
/// @throws InputError for an empty selection, or a bad table of a motion.
tissue::Surroundings surroundingsOf(const Scene& scene, const OrganConfig& organ,
                                    const mesh::TetMesh& mesh, const std::string& key);

/// Free components of points X, 3 x n, in the organ's frame, for models with glue only.
/// @throws InputError as surroundingsOf(), and for another support.
fem::FreeMask glued(const Scene& scene, const OrganConfig& organ, const Points& X,
                    const std::string& key);

}  // namespace palpate::scene
