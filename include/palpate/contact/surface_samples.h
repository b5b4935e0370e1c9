// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::contact {

/// A material point of the tissue surface that feels contact: p = sum_k weights[k] x[nodes[k]] +
/// offset.
struct SurfaceSample {
  Eigen::Vector3i nodes;  ///< Corners of a surface triangle that carries the point.
  Vec3 weights;           ///< Barycentric, >= 0, sum 1.
  double area;            ///< Rest area that it stands for [m^2]; all samples: the whole surface.
  /// From that point to where it is felt, in the world [m]: of a surface that is finer than the
  /// triangles that carry it.
  Vec3 offset = Vec3::Zero();

  Vec3 position(const Points& x) const { return of(x) + offset; }
  /// Of the nodes' d, 3 x n, what it is at the sample.
  Vec3 of(const Points& d) const {
    return weights[0] * d.col(nodes[0]) + weights[1] * d.col(nodes[1]) +
           weights[2] * d.col(nodes[2]);
  }
  /// Of the triangle [m].
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

/// How far apart samples are [m]: what is thick need not meet as many as a thin tool does.
struct SampleSpacing {
  SampleSpacing(double all = 0.0) : instruments(all) {}  // NOLINT(google-explicit-constructor)

  /// Of samples that meet both.
  double finest() const { return anatomy > 0.0 ? std::min(instruments, anatomy) : instruments; }

  double instruments;
  double anatomy = 0.0;  ///< Where the anatomy meets samples of its own; 0: those of instruments.
};

/// Into how many parts an edge is parted.
int sampleDivisions(double length, double spacing);

constexpr int kLeastDivisions = 3;
constexpr int kMaxDivisions = 32;

}  // namespace palpate::contact
