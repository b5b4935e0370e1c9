// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/scene/body_config.h"

namespace palpate::scene {

/// Materials and fibre frames of the tetrahedra of `mesh`, in the body's own frame, scaled [m];
/// `R_WB`: rotates fibre frames to those of the result; `file`, `key`: source for errors, such as
/// "organs[0]".
/// @throws InputError: as makeSolid(); a region that selects no tetrahedron, or by cell data that
/// the mesh does not have; a law that needs directions where there are none, or where they are
/// zero, not finite, or the sheet lies along the fibre.
fem::Composition composeBody(const BodyConfig& body, const mesh::TetMesh& mesh, const Mat3& R_WB,
                             const std::string& file, const std::string& key);

}  // namespace palpate::scene
