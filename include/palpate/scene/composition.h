// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/scene/body_config.h"

namespace palpate::scene {

/// Materials and fibre frames of the tetrahedra of `mesh`, in the body's frame, scaled [m]. `R_WB`
/// rotates fibre frames to those of the result. `file` and `key` ("organs[0]") name the source in
/// errors.
/// @throws InputError: as makeSolid(); a region without tetrahedra, or with missing cell data;
/// missing, zero or non-finite directions for a law that needs them; a sheet parallel to the fibre.
fem::Composition composeBody(const BodyConfig& body, const mesh::TetMesh& mesh, const Mat3& R_WB,
                             const std::string& file, const std::string& key);

}  // namespace palpate::scene
