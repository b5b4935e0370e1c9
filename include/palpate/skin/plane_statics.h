// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "palpate/skin/plane_triangle.h"

namespace palpate::skin {

using PlanePoints = Eigen::Matrix<double, 2, Eigen::Dynamic>;  ///< x, z of each node

/// Triangles of several materials.
struct PlaneMesh {
  PlanePoints points;                         ///< 2 x n [m]
  std::vector<std::array<int, 3>> triangles;  ///< Nodes
  std::vector<int> materials;                 ///< Of each triangle: 0, 1, ...

  Corners corners(std::size_t triangle) const;
};

/// Entries per row of the upper half of a banded stiffness, (D + 1) f (2.19): D is the largest
/// difference of node numbers in a triangle, f = 2 the number of components per node.
int bandWidth(const PlaneMesh& mesh);

/// 2n x 2n, for x, z of each node [N/m]; `elasticity` per material.
Eigen::SparseMatrix<double> stiffness(const PlaneMesh& mesh,
                                      const std::vector<Eigen::Matrix4d>& elasticity,
                                      Idealization idealization, double thickness);

/// Equilibrium displacements (2 x n) under `forces`; components with `held` = 1 are as in
/// `prescribed`, whose other components are ignored.
/// @throws std::domain_error if the free part is not positive definite: missing supports.
PlanePoints displacements(const Eigen::SparseMatrix<double>& stiffness, const PlanePoints& forces,
                          const PlanePoints& held, const PlanePoints& prescribed);

}  // namespace palpate::skin
