// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/thread_pool.h"
#include "palpate/material/constants.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::bem {

/// Errors of surfaceStiffness() for a body with a closed-form solution.
struct KnownBody {
  Eigen::Index points = 0, triangles = 0;
  double edge = 0.0;               ///< Mean edge over side or inner radius.
  double error = 0.0;              ///< Largest error over the largest displacement.
  double stress = 0.0;             ///< At a cavity's equator along the pull, over the far stress.
  double skew = 0.0, rigid = 0.0;  ///< See SurfaceStiffness.
};

/// A sphere about the origin: an icosahedron with edges halved `level` times, 10 * 4^level + 2
/// points. Inward: a cavity.
mesh::SurfaceMesh sphere(int level, double radius, bool outward = true);

/// A cube of cells^3, pulled at one face, with normal supports at three.
KnownBody cubeInTension(const material::Moduli& moduli, int cells, ThreadPool* pool = nullptr);
/// A sphere of radius 2 with a concentric cavity of radius 1 under pressure [Lame]:
/// u = A r + B / r^2.
KnownBody hollowSphere(const material::Moduli& moduli, int level, ThreadPool* pool = nullptr);
/// A spherical cavity in an infinite body in tension. The strain of its points is uniform: 1 / (1 -
/// alpha) of the far volumetric and 1 / (1 - beta) of the far distortional strain [Eshelby 1957].
KnownBody sphericalCavity(const material::Moduli& moduli, int level, ThreadPool* pool = nullptr);
/// Stress at the cavity's equator along the pull over the far stress, (27 - 15 nu) / (2 (7 - 5 nu))
/// [Goodier 1933].
double cavityStress(double poisson_ratio);

}  // namespace palpate::bem
