// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>

#include "palpate/enrichment/kernel_map.h"
#include "palpate/enrichment/perceptron.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::enrichment {

/// Displacements of single points that a surrogate was trained with, as inputs: how far others are
/// from them. A press on the way to one of them, shorter and alike, has been seen with it.
struct SeenRegion {
  Eigen::Matrix<double, 6, Eigen::Dynamic> samples;  ///< Scaled as inputs of KernelMap are.
  double threshold = 1.0;                            ///< A distance.

  /// Distance to the nearest way from (place, 0) to (place, displacement) of a sample.
  double distance(const Vec6& x) const;
};

/// A body's answer to the displacement of one point of its surface, learned from a database of
/// presses: the force, and how all of the surface is displaced, in a few modes.
struct Surrogate {
  mesh::SurfaceMesh surface;  ///< At rest, in the organ's frame [m].
  Eigen::MatrixXf modes;      ///< Of its displacements, 3n x m, orthonormal.
  double patch = 0.0;         ///< Radius of what was pressed [m].
  std::string made_by;        ///< How the database was made.

  Vec6 middle = Vec6::Zero();  ///< Of places [m] and displacements [m],
  Vec6 scale = Vec6::Ones();   ///< and their scales [m], for inputs of the map.
  double displacement_scale = 1.0, force_scale = 1.0, mode_scale = 1.0;  ///< [m], [N], [m]
  double longest = 0.0;   ///< Displacement that was seen [m]; beyond it A stays.
  Eigen::MatrixXd plain;  ///< What of A is everywhere the same, (3 + m) x 3.
  std::variant<KernelMap, Perceptron> map;
  SeenRegion seen;
  Vec6 seen_scale = Vec6::Ones();  ///< [m]

  Eigen::Index numModes() const { return modes.cols(); }
  /// Of the map.
  Eigen::Index numParameters() const;

  /// Where the point `place` [m] of the surface is displaced by `displacement` [m]: the force [N]
  /// that does so and, unless null, coefficients of the modes (m) [m]. `work` is of any size.
  /// Allocates nothing where they have their sizes; finite for all that is finite.
  void predict(const Vec3& place, const Vec3& displacement, Eigen::VectorXd* work, Vec3* force,
               Eigen::VectorXd* coefficients);

  /// How far from all that was seen: up to 1 it is no farther than samples are from each other.
  double strangeness(const Vec3& place, const Vec3& displacement) const;

  /// Displacements of the surface's points, 3 x n [m].
  void shape(const Eigen::VectorXd& coefficients, Points* displacements) const;
};

}  // namespace palpate::enrichment
