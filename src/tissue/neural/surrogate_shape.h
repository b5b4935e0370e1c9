// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/enrichment/surrogate.h"
#include "palpate/fem/supports.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::tissue {

/// A surrogate's modes on the nodes of a mesh of the same body: on the boundary taken from the
/// nearest place of the surrogate's surface, zero where the body is held, and between as the mean
/// of the neighbours, so that they fill the body.
class SurrogateShape {
 public:
  /// `body`: linear tetrahedra at rest in the organ's frame [m], of which `boundary` are the faces
  /// and `free` the components that are not held; `R_WO`: of the displacements told.
  /// @throws std::invalid_argument where the boundary is farther from the surrogate's surface than
  /// a twentieth of the body's size.
  SurrogateShape(const enrichment::Surrogate& surrogate, const mesh::CellMesh& body,
                 const Eigen::Matrix3Xi& boundary, const fem::FreeMask& free, const Mat3& R_WO);

  /// Adds to positions x, 3 x n [m]. `coefficients` [m]. Allocates nothing.
  void displace(const Eigen::VectorXd& coefficients, Points* x) const;

 private:
  Eigen::MatrixXd modes_;  // 3n x m
};

}  // namespace palpate::tissue
