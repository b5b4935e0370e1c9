// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/thread_pool.h"
#include "palpate/material/constants.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::bem {

/// More points than that are refused: 2 m triangles have a dense matrix of 6 m x 6 m (288 MB), of
/// which the factor goes with the cube of m.
constexpr Eigen::Index kMaxSurfacePoints = 1000;

/// Linear elastostatics of a body by its surface alone: the nodal forces of the displacements of
/// the surface's n points.
struct SurfaceStiffness {
  Eigen::MatrixXd matrix;  ///< Symmetric, 3 n x 3 n [N/m].
  /// Force on a point by a rigid motion, over that by as large a motion of it alone; the largest,
  /// before rigid motions were taken out.
  double rigid;
  double skew;  ///< ||V - V^T|| / ||V|| of the single layer before it became symmetric.
};

/// The discrete Steklov-Poincare operator, by symmetric Galerkin boundary elements with linear
/// displacements u and a constant traction on each triangle [Steinbach 2008]:
///
///   S = D + (M/2 + K)^T V^-1 (M/2 + K),
///
/// V of Kelvin's kernel, K of its traction and D hypersingular, both by V, by the potentials of
/// 1/r and by derivatives of u along the surface [Kupradze 1979; Han 1994]. Tractions jump at
/// edges, corners need nothing of their own, and S is semidefinite on any mesh. Its forces do no
/// work on rigid motions: what quadrature leaves of it is projected out.
///
/// `surface`: closed, outward; cavities inward. One that encloses a negative volume is a cavity in
/// an infinite body, which resists rigid motions too.
/// @throws std::invalid_argument for more than kMaxSurfacePoints, a triangle without area, or
/// moduli that are not positive.
SurfaceStiffness surfaceStiffness(const mesh::SurfaceMesh& surface, const material::Moduli& moduli,
                                  ThreadPool* pool = nullptr);

/// Displacements by unit forces where `free`, 3 x n, is 1 [m/N], and zero where it is 0.
/// @throws std::invalid_argument if what is held leaves the surface a motion.
Eigen::MatrixXd surfaceCompliance(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& free,
                                  ThreadPool* pool = nullptr);

/// Nodal forces, 3 x n [N], of tractions that are constant on each triangle, 3 x m [Pa].
Points tractionForces(const mesh::SurfaceMesh& surface, const Points& tractions);

/// Nodal forces, 3 x n [N], that stand for the force f [N/m^3] on all of the volume: those of the
/// stiffness under a particular solution w less the tractions of w,
///
///   w = -(f.(X - Xo))^2 / (2 (lambda + 2 mu) f.f) f,
///
/// Xo the middle of the surface. Their sum is f times the volume, exactly.
Points bodyForces(const mesh::SurfaceMesh& surface, const material::Moduli& moduli,
                  const Eigen::MatrixXd& stiffness, const Vec3& f);

}  // namespace palpate::bem
