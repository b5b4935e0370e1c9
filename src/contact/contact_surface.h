// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/surface_contact.h"
#include "palpate/contact/surface_samples.h"
#include "palpate/contact/triangle_distance.h"
#include "triangle_tree.h"

namespace palpate::contact {

/// Precomputed data of a tissue surface for contact with others: samples, tree of triangles,
/// neighbours, sizes at rest.
class ContactSurface {
 public:
  ContactSurface(const Points& X, const Eigen::Matrix3Xi& triangles);

  /// Rest positions of the body, 3 x n [m].
  const Points& atRest() const { return X_; }
  /// Triangles, outward, 3 x m.
  const Eigen::Matrix3Xi& triangles() const { return triangles_; }
  const std::vector<SurfaceSample>& samples() const { return samples_; }
  const TriangleTree& tree() const { return tree_; }
  /// Bounding ball of a triangle at rest [m].
  Vec3 middle(int triangle) const { return middles_.col(triangle); }
  double size(int triangle) const { return sizes_[triangle]; }
  /// Half of the tenth percentile of the body's thickness at rest [m].
  double radius() const { return radius_; }
  double meanEdge() const { return mean_edge_; }
  /// Largest penetration that contact resolves [m].
  double depth() const;

  Mat3 corners(const Eigen::Ref<const Points>& x, int triangle) const;
  /// Normal of a triangle at x, outward, unit.
  Vec3 normal(const Eigen::Ref<const Points>& x, int triangle) const;
  /// Angle-weighted pseudonormal at the point `near` of a triangle, unit. Its sign decides the side
  /// of a closed surface at the nearest point [Baerentzen, Aanaes 2005].
  Vec3 pseudonormal(const Eigen::Ref<const Points>& x, int triangle,
                    const TrianglePoint& near) const;

  /// Calls visit(triangle) for the other triangles around the edge or corner of `near`.
  template <class Visit>
  void forAround(int triangle, const TrianglePoint& near, const Visit& visit) const {
    if (near.feature == Feature::kEdge && beyond_(near.corner, triangle) >= 0) {
      visit(beyond_(near.corner, triangle));
    }
    if (near.feature != Feature::kVertex) return;
    const auto node = static_cast<std::size_t>(triangles_(near.corner, triangle));
    for (int k = around_start_[node]; k < around_start_[node + 1]; ++k) {
      if (const int t = around_[static_cast<std::size_t>(k)]; t != triangle) visit(t);
    }
  }

 private:
  void findNeighbours();
  void measure();

  Points X_;
  Eigen::Matrix3Xi triangles_;
  std::vector<SurfaceSample> samples_;
  TriangleTree tree_;
  Eigen::Matrix3Xi beyond_;  // neighbour across the edge that begins at a corner, or -1
  std::vector<int> around_start_, around_;  // triangles of each node
  Points middles_;
  Eigen::VectorXd sizes_;
  double radius_ = 0.0, mean_edge_ = 0.0;
};

}  // namespace palpate::contact
