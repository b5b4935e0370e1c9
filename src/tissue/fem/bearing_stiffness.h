// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::tissue {

/// How the tissue around each node of a surface bears what presses there: Young's modulus at rest,
/// of the stiffest solid around, over the mean length of the edges [Pa/m]; 0 where there is no
/// surface. `triangles`: the surface.
Eigen::VectorXd bearingStiffness(const mesh::TetMesh& mesh, const Eigen::Matrix3Xi& triangles,
                                 const fem::Composition& composition);

}  // namespace palpate::tissue
