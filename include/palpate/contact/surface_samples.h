// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::contact {

/// A material point of the tissue surface at which contact is evaluated:
/// p = sum_k weights[k] x[nodes[k]] + offset.
struct SurfaceSample {
  Eigen::Vector3i nodes;  ///< Corners of the surface triangle with the point.
  Vec3 weights;           ///< Barycentric, >= 0, sum 1.
  double area;  ///< Rest area of the sample [m^2]; the sum over samples is that of the surface.
  /// Offset from the triangle to the contact point, world [m]; for a surface finer than the
  /// triangles.
  Vec3 offset = Vec3::Zero();

  Vec3 position(const Points& x) const { return of(x) + offset; }
  /// Nodal vectors `d`, 3 x n, interpolated to the sample.
  Vec3 of(const Points& d) const {
    return weights[0] * d.col(nodes[0]) + weights[1] * d.col(nodes[1]) +
           weights[2] * d.col(nodes[2]);
  }
  /// Mean edge length of the sample's triangle at x [m].
  double meanEdge(const Points& x) const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += (x.col(nodes[(k + 1) % 3]) - x.col(nodes[k])).norm();
    return sum / 3.0;
  }
};

/// The nodes of the surface, points that part its edges, where these are longer than `spacing` [m],
/// into equal pieces, and points within triangles on a lattice as dense as on their longest edge,
/// so that no two neighbours are farther apart; each point once, those of a triangle after those of
/// the one before. An edge has from kLeastDivisions to kMaxDivisions parts: with nodes alone a tool
/// could open the surface between them. `spacing` <= 0: nodes only.
std::vector<SurfaceSample> sampleSurface(const Points& X, const Eigen::Matrix3Xi& triangles,
                                         double spacing);

/// Largest distances of neighbouring samples [m]; the anatomy may have coarser ones than tools.
struct SampleSpacing {
  SampleSpacing(double all = 0.0) : instruments(all) {}  // NOLINT(google-explicit-constructor)

  /// Spacing of samples for both [m].
  double finest() const { return anatomy > 0.0 ? std::min(instruments, anatomy) : instruments; }

  double instruments;
  double anatomy = 0.0;  ///< Spacing of samples for the anatomy [m]; 0: those of instruments serve.
};

/// Number of parts of an edge of `length` [m].
int sampleDivisions(double length, double spacing);

constexpr int kLeastDivisions = 3;
constexpr int kMaxDivisions = 32;

}  // namespace palpate::contact
