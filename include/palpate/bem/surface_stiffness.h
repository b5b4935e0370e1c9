// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/thread_pool.h"
#include "palpate/material/constants.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::bem {

/// Limit of surface points: 2 m triangles have a dense matrix of 6 m x 6 m (288 MB), factorised at
/// cubic cost.
constexpr Eigen::Index kMaxSurfacePoints = 1000;

/// Linear elastostatics of a body by its surface: nodal forces of the displacements of its n
/// points.
struct SurfaceStiffness {
  Eigen::MatrixXd matrix;  ///< Symmetric, 3 n x 3 n [N/m].
  /// Largest force on a point by a rigid motion, over that by an equal motion of the point alone,
  /// before rigid motions were projected out [-].
  double rigid;
  double skew;  ///< ||V - V^T|| / ||V|| of the single layer before it was symmetrised.
};

/// The discrete Steklov-Poincare operator, by symmetric Galerkin boundary elements with linear
/// displacements u and a constant traction on each triangle [Steinbach 2008]:
///
///   S = D + (M/2 + K)^T V^-1 (M/2 + K),
///
/// V is the single layer of Kelvin's kernel, K its double layer, D the hypersingular operator. K
/// and D use V, potentials of 1/r and surface derivatives of u [Kupradze 1979; Han 1994]. Tractions
/// jump at edges, corners need no treatment, and S is semidefinite on any mesh. Rigid motions have
/// no forces: their quadrature error is projected out.
///
/// `surface`: closed, outward; cavities inward. A negative enclosed volume means a cavity in an
/// infinite body, which also resists rigid motions.
/// @throws std::invalid_argument for more than kMaxSurfacePoints, a triangle without area, or
/// moduli not > 0.
SurfaceStiffness surfaceStiffness(const mesh::SurfaceMesh& surface, const material::Moduli& moduli,
                                  ThreadPool* pool = nullptr);

/// Displacements due to unit forces where `free`, 3 x n, is 1 [m/N]; zero where it is 0.
/// @throws std::invalid_argument if the supports leave a rigid motion.
Eigen::MatrixXd surfaceCompliance(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& free,
                                  ThreadPool* pool = nullptr);

/// Nodal forces, 3 x n [N], of tractions that are constant on each triangle, 3 x m [Pa].
Points tractionForces(const mesh::SurfaceMesh& surface, const Points& tractions);

/// Nodal forces, 3 x n [N], equivalent to the body force f [N/m^3] on the whole volume: the
/// stiffness times a particular solution w, minus the tractions of w,
///
///   w = -(f.(X - Xo))^2 / (2 (lambda + 2 mu) f.f) f,
///
/// Xo is the centre of the surface. Their sum is exactly f times the volume.
Points bodyForces(const mesh::SurfaceMesh& surface, const material::Moduli& moduli,
                  const Eigen::MatrixXd& stiffness, const Vec3& f);

}  // namespace palpate::bem
