// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/fem/block_matrix.h"
#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::tissue {

/// Hooke's law at the deformation gradient F [Pa].
Mat3 hookeStress(const material::Solid& solid, const Mat3& F);

/// += the tensors of tetrahedron t, of `volume` [m^3], at its corners and edges: K_jk of
/// TensorMassElasticity [N/m]. The pattern of `sums` has them.
void addTensors(const mesh::TetMesh& mesh, Eigen::Index t, double volume,
                const material::Solid& solid, fem::BlockMatrix* sums);

}  // namespace palpate::tissue
