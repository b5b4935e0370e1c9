// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Sparse>

#include "palpate/bem/plane_elements.h"

namespace palpate::bem {

/// Plate for comparison of boundary elements with linear triangles [Castillo Leon 2011, ch. 5]:
/// plane stress, left side clamped, a uniform traction to the right on the right side. The text
/// omits its size: here the unit square.
struct PlanePlate {
  double young_modulus = 210e9;  ///< [Pa]
  double poisson_ratio = 0.3;
  double traction = 3e6;  ///< [Pa]
};

/// The plate of cells x cells squares, each of four triangles about a middle node.
struct PlateOfTriangles {
  Eigen::Matrix2Xd points;     ///< 2 x n: corners of the cells row by row, then middle nodes [m].
  Eigen::Matrix3Xi triangles;  ///< 3 x 4 cells^2, anticlockwise.
  Eigen::SparseMatrix<double> matrix;  ///< K, 2 n x 2 n, of unit thickness [Pa]; before clamping.
  Eigen::Matrix2Xd displacement;       ///< 2 x n [m]
};
PlateOfTriangles plateOfTriangles(const PlanePlate& plate, int cells);

/// The plate of 4 x `per_side` boundary elements, anticlockwise from the lower left corner.
struct PlateOfElements {
  PlaneElements elements;
  PlaneSolution solution;
};
PlateOfElements plateOfElements(const PlanePlate& plate, int per_side);

}  // namespace palpate::bem
