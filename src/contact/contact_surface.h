// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/surface_contact.h"
#include "palpate/contact/surface_samples.h"
#include "palpate/contact/triangle_distance.h"
#include "triangle_tree.h"

namespace palpate::contact {

/// A surface of soft tissue as contact with another one needs it: its points that feel, and what of
/// it does not change while it moves.
class ContactSurface {
 public:
  ContactSurface(const Points& X, const Eigen::Matrix3Xi& triangles);

  /// Of the body, at rest, 3 x n [m].
  const Points& atRest() const { return X_; }
  /// Outward, 3 x m.
  const Eigen::Matrix3Xi& triangles() const { return triangles_; }
  const std::vector<SurfaceSample>& samples() const { return samples_; }
  const TriangleTree& tree() const { return tree_; }
  /// A ball around a triangle at rest [m].
  Vec3 middle(int triangle) const { return middles_.col(triangle); }
  double size(int triangle) const { return sizes_[triangle]; }
  /// Half of the body's thickness at rest, where nine tenths of its surface are thicker [m].
  double radius() const { return radius_; }
  double meanEdge() const { return mean_edge_; }
  /// So deep a sample of another surface is pushed back out [m].
  double depth() const;

  Mat3 corners(const Eigen::Ref<const Points>& x, int triangle) const;
  /// Outward, unit.
  Vec3 normal(const Eigen::Ref<const Points>& x, int triangle) const;
  /// Unit normal of the point `near` of a triangle: of an edge the mean of both sides', of a corner
  /// that of all triangles around it, weighted by their angles. Where it is the nearest point of a
  /// closed surface, its sign says on which side one is (Baerentzen and Aanaes 2005).
  Vec3 pseudonormal(const Eigen::Ref<const Points>& x, int triangle,
                    const TrianglePoint& near) const;

  /// visit(triangle) of the others around the edge or corner that is `near` to something.
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
  Eigen::Matrix3Xi beyond_;  // triangle beyond the edge that begins at a corner, or -1
  std::vector<int> around_start_, around_;  // triangles around each node
  Points middles_;
  Eigen::VectorXd sizes_;
  double radius_ = 0.0, mean_edge_ = 0.0;
};

}  // namespace palpate::contact
