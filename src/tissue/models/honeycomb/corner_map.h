// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell_balance.h"

namespace palpate::tissue {

/// Positions of cell corners: along an axis the mean of the adjacent sides normal to it, rotated
/// with the mean of the adjacent cells, to first order. The transpose maps corner forces to sides
/// and rotations, with lever arms l/2 [as Wang 2005, eq. 3.12, for tangential ones].
class CornerMap {
 public:
  struct Term {
    int unknown;  ///< Index of a side, or number of sides + 3 cell + axis.
    double weight;
  };

  /// `free`: free components of the corners in O, 3 x n; `X_WO`: pose of the lattice's frame.
  CornerMap(const CellLattice& lattice, const HeldSides& held, const Eigen::Matrix3Xd& free,
            const Pose& X_WO);

  /// Rest positions of the corners, world, 3 x n [m].
  const Points& rest() const { return X_; }
  const Mat3& frame() const { return R_WO_; }
  /// Unknowns that move a corner along an axis of O, without held sides.
  const Term* begin(int corner, int axis) const { return terms_.data() + first(corner, axis); }
  const Term* end(int corner, int axis) const { return terms_.data() + first(corner, axis + 1); }

  /// Computes corner positions, world [m].
  void place(const CellState& state, Points* x) const;
  /// The same for surface corners only.
  void placeSurface(const CellState& state, Points* x) const;
  /// Displacement of corner i for the changes way(unknown), world [m].
  template <class Way>
  Vec3 way(int i, const Way& way) const {
    Vec3 d = Vec3::Zero();
    for (int a = 0; a < 3; ++a) {
      for (const Term* t = begin(i, a); t != end(i, a); ++t) d[a] += t->weight * way(t->unknown);
    }
    return R_WO_ * d;
  }
  /// Adds corner forces `f`, world, 3 x n [N], to sides [N] and rotations [N m].
  void pull(const Points& f, Eigen::VectorXd* sides, Eigen::VectorXd* turns) const;
  /// Sum of corner forces on held sides, world [N].
  Vec3 borne(const Points& f) const;
  /// Least-squares sides and rotations for corner positions x, 3 x n [m]; without pressures.
  void fit(const Points& x, CellState* state) const;

 private:
  std::size_t first(int corner, int axis) const {
    return static_cast<std::size_t>(first_[static_cast<std::size_t>(3 * corner + axis)]);
  }
  int num_sides_;
  Points X_;
  Mat3 R_WO_;
  double arm_;  // lever arm as weight of rotations [m]
  std::vector<Term> terms_;
  std::vector<int> first_;
  std::vector<int> surface_;  // corners of triangles, ascending
};

}  // namespace palpate::tissue
