// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>

#include "palpate/enrichment/kernel_map.h"
#include "palpate/enrichment/perceptron.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::enrichment {

/// Region covered by training displacements of single points, for the distance of others. A sample
/// also covers shorter displacements in the same direction.
struct SeenRegion {
  Eigen::Matrix<double, 6, Eigen::Dynamic> samples;  ///< Scaled as inputs of KernelMap.
  double threshold = 1.0;                            ///< Distance with strangeness 1.

  /// Distance to the nearest segment from (place, 0) to (place, displacement) of a sample.
  double distance(const Vec6& x) const;
};

/// Response of a body to the displacement of a surface point, learned from a database of presses:
/// the force, and the displacement of the whole surface in a few modes.
struct Surrogate {
  mesh::SurfaceMesh surface;  ///< At rest, in the organ's frame [m].
  Eigen::MatrixXf modes;      ///< Modes of displacements, 3n x m, orthonormal.
  double patch = 0.0;         ///< Radius of the press [m].
  std::string made_by;        ///< Request text of the database.

  Vec6 middle = Vec6::Zero();  ///< Mean of places and displacements [m].
  Vec6 scale = Vec6::Ones();   ///< Scales of these as inputs of the map [m].
  double displacement_scale = 1.0, force_scale = 1.0, mode_scale = 1.0;  ///< [m], [N], [m]
  double longest = 0.0;   ///< Longest displacement in the samples [m]; A is constant beyond.
  Eigen::MatrixXd plain;  ///< Constant part of A, (3 + m) x 3.
  std::variant<KernelMap, Perceptron> map;
  SeenRegion seen;
  Vec6 seen_scale = Vec6::Ones();  ///< [m]

  Eigen::Index numModes() const { return modes.cols(); }
  /// Number of parameters of the map.
  Eigen::Index numParameters() const;

  /// For the displacement `displacement` [m] of the surface point `place` [m]: the force [N] that
  /// causes it and, if not null, mode coefficients (m) [m]. `work` may have any size. Does not
  /// allocate if sizes fit; finite for finite input.
  void predict(const Vec3& place, const Vec3& displacement, Eigen::VectorXd* work, Vec3* force,
               Eigen::VectorXd* coefficients);

  /// Distance from the training region; up to 1 within the distances between samples.
  double strangeness(const Vec3& place, const Vec3& displacement) const;

  /// Displacements of the surface's points, 3 x n [m].
  void shape(const Eigen::VectorXd& coefficients, Points* displacements) const;
};

}  // namespace palpate::enrichment
