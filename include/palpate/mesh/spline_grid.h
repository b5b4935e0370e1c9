// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/types.h"

namespace palpate::mesh {

/// Cubes of equal size that fill a box.
struct GridBox {
  Vec3 low = Vec3::Zero();                          ///< Its lowest corner [m].
  double spacing = 1.0;                             ///< Edge of a cube [m], > 0.
  Eigen::Vector3i cells = Eigen::Vector3i::Ones();  ///< Cubes along each axis, >= 1.

  Vec3 high() const { return low + spacing * cells.cast<double>(); }
  /// Corners of cubes.
  Eigen::Index numNodes() const { return (cells.array() + 1).cast<Eigen::Index>().prod(); }
  Vec3 node(int i, int j, int k) const { return low + spacing * Vec3(i, j, k); }
};

/// A function in a box and its derivatives at one point.
struct FieldPoint {
  double value;
  Vec3 gradient;
  Mat3 hessian;
};

/// A function in a box, twice continuously differentiable: tensor products of cubic B-splines
/// [de Boor 1978, chapter IX], through given values at the corners of the cubes.
struct SplineGrid {
  GridBox box;
  /// Of the splines about node (i, j, k), for each of -1 .. cells + 1, x first.
  Eigen::VectorXd coefficients;

  static Eigen::Index numCoefficients(const Eigen::Vector3i& cells) {
    return (cells.array() + 3).cast<Eigen::Index>().prod();
  }

  /// At a point of the box.
  double value(const Vec3& p) const;
  /// The same, with its derivatives by p; the same bits of the value.
  FieldPoint at(const Vec3& p) const;
};

/// The spline through `values` at the nodes, x first; on the faces of the box its second derivative
/// along their normal is zero ("natural").
SplineGrid interpolate(const GridBox& box, const Eigen::VectorXd& values);

}  // namespace palpate::mesh
