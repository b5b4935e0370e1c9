// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::tissue {

/// Stiffness scale at each surface node: Young's modulus at rest of the stiffest adjacent solid
/// over the mean edge length [Pa/m]; 0 off the surface. `triangles`: the surface.
Eigen::VectorXd bearingStiffness(const mesh::TetMesh& mesh, const Eigen::Matrix3Xi& triangles,
                                 const fem::Composition& composition);

}  // namespace palpate::tissue
