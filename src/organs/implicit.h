// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::organs {

/// A body given by a function that is negative inside, positive outside, and grows about as the
/// distance [m] near the surface.
struct ImplicitBody {
  std::function<double(const Vec3&)> value;
  Vec3 min, max;  ///< [m] a box around it, with some room.
};

/// About the distance from an ellipsoid about the origin: |q| (|q| - 1) / |grad| with q = p / r,
/// exact to first order at the surface.
double ellipsoid(const Vec3& p, const Vec3& radii);

/// Distance from a ball that is swept from `a` to `b` while its radius goes from `ra` to `rb`.
double taperedCapsule(const Vec3& p, const Vec3& a, double ra, const Vec3& b, double rb);

/// Union of two bodies, blended over the length `blend` [m].
double smoothUnion(double a, double b, double blend);

/// `a` without `b`, the rim rounded over the length `blend` [m].
double smoothDifference(double a, double b, double blend);

/// Closed triangulation of the body's surface on a grid of `spacing` [m] by marching tetrahedra
/// (Doi and Koide 1991). The triangles are of all shapes, but none is degenerate.
mesh::SurfaceMesh marchTetrahedra(const ImplicitBody& body, double spacing);

/// Near-uniform triangles of about `edge_length` [m], with points on the body's surface.
mesh::SurfaceMesh meshImplicit(const ImplicitBody& body, double edge_length);

}  // namespace palpate::organs
