// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/surface_samples.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/surface_points.h"

namespace palpate::tissue {

/// A surface that is carried by a coarser one: each point moves with the place of the coarse
/// triangles that is nearest to it at rest, keeps its distance from there, in the world's
/// directions, and has a detail of its own beside.
class FineSurface {
 public:
  /// Both at rest in the world [m]; of `coarse` the points may be nodes of a body. `spacing`: of
  /// samples, see contact::sampleSurface().
  FineSurface(const mesh::SurfaceMesh& coarse, mesh::SurfaceMesh fine, double spacing);

  Eigen::Index numPoints() const { return fine_.points.cols(); }
  const Eigen::Matrix3Xi& triangles() const { return fine_.triangles; }
  const Points& rest() const { return fine_.points; }

  /// What nodal values x (3 x m) are where the points are carried; without distance and detail.
  void carried(const Points& x, Points* there) const { mesh::interpolate(places_, x, there); }
  /// From there to the points at rest, 3 x n [m].
  const Points& distance() const { return distance_; }

  /// Where contact is felt, between coarse nodes, at rest.
  const std::vector<contact::SurfaceSample>& samples() const { return samples_; }
  /// Their offsets where the points have this detail, 3 x n [m].
  void offsets(const Points& detail, Points* offsets) const;

 private:
  mesh::SurfaceMesh fine_;
  std::vector<mesh::SurfacePoint> places_;
  Points distance_;
  std::vector<contact::SurfaceSample> on_fine_, samples_;  // between fine points, coarse nodes
};

}  // namespace palpate::tissue
