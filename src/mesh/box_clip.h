// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "palpate/mesh/cutaway.h"

namespace palpate::mesh {

/// A face of a box at a finite distance.
struct BoxFace {
  int axis;
  double at;  ///< [m]
  int into;   ///< 1: the box lies above `at`; -1: below.
};

std::vector<BoxFace> facesOf(const CutBox& box);

/// A convex polygon in a tetrahedron or triangle; each vertex by weights of four corners.
struct CutPolygon {
  std::vector<Eigen::Vector4d> vertices;
};

/// Distances of four corners from the faces of a box, > 0 into the box, 0 on it.
class CornerDepths {
 public:
  /// `x`: the corners, 3 x 4 [m]; distances below `close` [m] count as 0.
  CornerDepths(const Eigen::Matrix<double, 3, 4>& x, const std::vector<BoxFace>& faces,
               double close);

  std::size_t numFaces() const { return depths_.size(); }
  const Eigen::Vector4d& operator[](std::size_t face) const { return depths_[face]; }

  /// Part of `polygon` on the box's side of face `face` (`inside`), or on the other side.
  CutPolygon clip(const CutPolygon& polygon, std::size_t face, bool inside) const;
  /// Adds the parts of `triangle` (the first three corners) outside the box. A triangle in a face
  /// is on the side of the fourth corner; without one (`has_fourth` false) it is outside.
  void addOutside(const CutPolygon& triangle, bool has_fourth,
                  std::vector<CutPolygon>* pieces) const;
  /// Section of the tetrahedron by the face, within the box; empty if no part of the tetrahedron is
  /// outside the face.
  CutPolygon section(std::size_t face) const;

 private:
  std::vector<Eigen::Vector4d> depths_;  // one per face
};

}  // namespace palpate::mesh
