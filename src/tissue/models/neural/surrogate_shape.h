// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/enrichment/surrogate.h"
#include "palpate/fem/supports.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::tissue {

/// A surrogate's modes on the nodes of a body's mesh: boundary nodes from the nearest point of the
/// surrogate's surface, held nodes zero, interior nodes the mean of their neighbours.
class SurrogateShape {
 public:
  /// `body`: linear tetrahedra, rest configuration, organ's frame [m]; `boundary`: its faces;
  /// `free`: its free components; `R_WO`: rotates displacements to world.
  /// @throws std::invalid_argument where the boundary is farther from the surrogate's surface than
  /// 5 % of the body's size.
  SurrogateShape(const enrichment::Surrogate& surrogate, const mesh::CellMesh& body,
                 const Eigen::Matrix3Xi& boundary, const fem::FreeMask& free, const Mat3& R_WO);

  /// x += displacements of the modes, 3 x n [m]; `coefficients` [m]. Allocates nothing.
  void displace(const Eigen::VectorXd& coefficients, Points* x) const;

 private:
  Eigen::MatrixXd modes_;  // 3n x m
};

}  // namespace palpate::tissue
