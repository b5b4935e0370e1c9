// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/scene/body_config.h"

namespace palpate::scene {

/// What each tetrahedron of `mesh` is made of. `mesh` is the body in its own frame, after scaling;
/// `R_WB` turns that frame to the one that the frames of the composition are wanted in. `file` is
/// the scene or case that says it, and `key` the place of the body in it ("organs[0]", or "").
/// @throws InputError: as makeSolid(); a region that selects no tetrahedron, or by cell data that
/// the mesh does not have; a law that needs directions where there are none, or where they are
/// zero, not finite, or the sheet lies along the fibre.
fem::Composition composeBody(const BodyConfig& body, const mesh::TetMesh& mesh, const Mat3& R_WB,
                             const std::string& file, const std::string& key);

}  // namespace palpate::scene
