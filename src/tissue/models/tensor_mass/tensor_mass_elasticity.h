// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "tissue/models/cells/cell_elasticity.h"

namespace palpate::tissue {

/// The tensor-mass model [Cotin, Delingette, Ayache 2000; Wang 2005, (2.16)-(2.18)]. In a
/// tetrahedron of volume V with outward area vectors M_j opposite its corners, twice the faces'
/// areas, the force on corner j is minus
///
///   sum_k K_jk (x_k - X_k),   K_jk = 1/(36 V) (l M_j M_k^T + m M_k M_j^T + m (M_j . M_k) I),
///
/// with Lame's constants l and m: linear elasticity without large rotations. Tensors of all
/// tetrahedra are summed once per point and edge; a force is a sum over edges.
class TensorMassElasticity final : public CellElasticity {
 public:
  /// @throws as CellElasticity
  TensorMassElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition);

  double energy(const Points& x) override;
  double gradient(const Points& x, Points* g) override;
  void hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) override;

 private:
  Mat3 cauchyStress(const Points& x, int t, const Mat3& F) override;
  double energyOf(const Points& x, int t) override;

  fem::BlockMatrix tensors_;
  Points u_, f_;
};

}  // namespace palpate::tissue
