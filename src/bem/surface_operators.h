// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/material/constants.h"
#include "palpate/mesh/surface_mesh.h"
#include "triangle_potentials.h"

namespace palpate::bem {

std::vector<Triangle> trianglesOf(const mesh::SurfaceMesh& surface);

/// Integral operators of a surface: test functions are 1 on one of m triangles; trial functions are
/// the same, or linear ones of the n points.
struct SurfaceOperators {
  Eigen::MatrixXd single_layer;  ///< V of Kelvin's kernel U, 3 m x 3 m [m^3/Pa].
  Eigen::MatrixXd inverse;       ///< V of 1 / (4 pi r), m x m [m^3].
  Eigen::MatrixXd double_layer;  ///< K of the normal derivative of 1 / (4 pi r), m x n [m^2].
  double skew;  ///< ||V - V^T|| / ||V|| before symmetrisation: the error of the outer quadrature.
};

/// Inner integrals in closed form, outer ones by outerRule(). Bitwise equal for any pool, which may
/// be null.
SurfaceOperators surfaceOperators(const mesh::SurfaceMesh& surface,
                                  const std::vector<Triangle>& triangles,
                                  const material::Moduli& moduli, ThreadPool* pool);

/// Kelvin's U [Brebbia, Dominguez 1992] is
/// 1/(16 pi mu (1 - nu)) [(3 - 4 nu) I / r + r r^T / r^3]: the factor [1/Pa], and 3 - 4 nu.
struct KelvinConstants {
  explicit KelvinConstants(const material::Moduli& moduli);
  double factor, isotropic;
};

}  // namespace palpate::bem
