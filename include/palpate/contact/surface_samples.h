// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::contact {

/// A material point of the tissue surface that feels contact: p = sum_k weights[k] x[nodes[k]].
struct SurfaceSample {
  Eigen::Vector3i nodes;  ///< Corners of a surface triangle that the point lies in.
  Vec3 weights;           ///< Barycentric, >= 0, sum 1.
  double area;            ///< Rest area that it stands for [m^2]; all samples: the whole surface.

  Vec3 position(const Points& x) const {
    return weights[0] * x.col(nodes[0]) + weights[1] * x.col(nodes[1]) +
           weights[2] * x.col(nodes[2]);
  }
};

/// The nodes of the surface and, where an edge is longer than `spacing` [m], points between them on
/// a regular lattice, so that no two neighbours are farther apart; each point once. The lattice has
/// as many parts an edge in all triangles, those that the longest edge needs, but where triangles
/// differ much in size as many as each triangle's own longest edge needs, three at least. At most
/// `kMaxDivisions`. `spacing` <= 0: nodes only.
std::vector<SurfaceSample> sampleSurface(const Points& X, const Eigen::Matrix3Xi& triangles,
                                         double spacing);

constexpr int kMaxDivisions = 32;

}  // namespace palpate::contact
