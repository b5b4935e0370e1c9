// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/mesh/tet_mesh.h"
#include "palpate/scene/scene.h"
#include "palpate/tissue/surroundings.h"

namespace palpate::scene {

/// What surrounds an organ, on `mesh` of it in its own frame. `key`: of the organ in the file.
/// @throws InputError for what selects nothing, and for a bad table of a motion.
tissue::Surroundings surroundingsOf(const Scene& scene, const OrganConfig& organ,
                                    const mesh::TetMesh& mesh, const std::string& key);

/// What is free of points X in the organ's own frame, 3 x n, where the organ is glued and no more.
/// @throws InputError likewise, and for another support.
fem::FreeMask glued(const Scene& scene, const OrganConfig& organ, const Points& X,
                    const std::string& key);

}  // namespace palpate::scene
