// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::organs {

/// A body as an implicit function: negative inside, positive outside, near the surface about the
/// distance [m].
struct ImplicitBody {
  std::function<double(const Vec3&)> value;
  Vec3 min, max;  ///< A box around the body, with a margin [m].
};

/// Approximate distance from an ellipsoid about the origin: |q| (|q| - 1) / |grad| with q = p / r,
/// exact to first order at the surface.
double ellipsoid(const Vec3& p, const Vec3& radii);

/// Distance from a ball swept from `a` to `b`, with radius from `ra` to `rb`.
double taperedCapsule(const Vec3& p, const Vec3& a, double ra, const Vec3& b, double rb);

/// Union of two bodies, blended over the length `blend` [m].
double smoothUnion(double a, double b, double blend);

/// `a` without `b`, with the edge rounded over the length `blend` [m].
double smoothDifference(double a, double b, double blend);

/// Closed triangulation of the body's surface on a grid of `spacing` [m] by marching tetrahedra
/// [Doi, Koide 1991]. Triangles have arbitrary shapes, but none is degenerate.
mesh::SurfaceMesh marchTetrahedra(const ImplicitBody& body, double spacing);

/// Nearly uniform triangles of about `edge_length` [m], with points on the body's surface.
mesh::SurfaceMesh meshImplicit(const ImplicitBody& body, double edge_length);

}  // namespace palpate::organs
