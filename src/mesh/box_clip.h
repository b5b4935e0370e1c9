// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "palpate/mesh/cutaway.h"

namespace palpate::mesh {

/// One face of a box that is not infinitely far away.
struct BoxFace {
  int axis;
  double at;  ///< [m]
  int into;   ///< 1: the box is beyond it, -1: before it.
};

std::vector<BoxFace> facesOf(const CutBox& box);

/// A convex polygon in a tetrahedron or triangle, each vertex by its parts of four corners.
struct CutPolygon {
  std::vector<Eigen::Vector4d> vertices;
};

/// Distances of four corners from the faces of a box, > 0 into the box, 0 on it.
class CornerDepths {
 public:
  /// `x`: the corners, 3 x 4 [m]; nearer than `close` [m] is on the face.
  CornerDepths(const Eigen::Matrix<double, 3, 4>& x, const std::vector<BoxFace>& faces,
               double close);

  std::size_t numFaces() const { return depths_.size(); }
  const Eigen::Vector4d& operator[](std::size_t face) const { return depths_[face]; }

  /// What of `polygon` is on the side of face `face` that is the box's (`inside`) or the other one.
  CutPolygon clip(const CutPolygon& polygon, std::size_t face, bool inside) const;
  /// Adds what of `triangle`, that of the first three corners, is outside of the box. One that lies
  /// in a face is where the fourth corner is; without (`has_fourth` false) it is outside.
  void addOutside(const CutPolygon& triangle, bool has_fourth,
                  std::vector<CutPolygon>* pieces) const;
  /// Where the tetrahedron of the four corners is cut by the face, as far as that is the box's; no
  /// vertices where no part of the tetrahedron is outside of the face.
  CutPolygon section(std::size_t face) const;

 private:
  std::vector<Eigen::Vector4d> depths_;  // one a face
};

}  // namespace palpate::mesh
