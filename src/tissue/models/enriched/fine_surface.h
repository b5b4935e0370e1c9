// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/surface_samples.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/surface_points.h"

namespace palpate::tissue {

/// A fine surface on a coarse one: each point moves with its nearest coarse surface point at rest,
/// at a constant offset in world axes, plus a detail.
class FineSurface {
 public:
  /// `fine`, `coarse`: rest configurations, world [m]; `spacing`: of contact::sampleSurface() [m].
  FineSurface(const mesh::SurfaceMesh& coarse, mesh::SurfaceMesh fine, double spacing);

  Eigen::Index numPoints() const { return fine_.points.cols(); }
  const Eigen::Matrix3Xi& triangles() const { return fine_.triangles; }
  const Points& rest() const { return fine_.points; }

  /// Interpolates nodal values x, 3 x m, to the coarse surface points; without offset and detail.
  void carried(const Points& x, Points* there) const { mesh::interpolate(places_, x, there); }
  /// Offsets from the coarse surface points at rest, 3 x n [m].
  const Points& distance() const { return distance_; }

  /// Contact samples on the coarse nodes, at rest.
  const std::vector<contact::SurfaceSample>& samples() const { return samples_; }
  /// Offsets of the samples for a detail of the points, 3 x n [m].
  void offsets(const Points& detail, Points* offsets) const;

 private:
  mesh::SurfaceMesh fine_;
  std::vector<mesh::SurfacePoint> places_;
  Points distance_;
  std::vector<contact::SurfaceSample> on_fine_, samples_;  // on fine points; on coarse nodes
};

}  // namespace palpate::tissue
