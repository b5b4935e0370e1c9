// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell_balance.h"

namespace palpate::tissue {

/// Where the corners of cells are: along an axis in the mean of the sides around that are normal to
/// it, turned with the mean of the cells around, to first order in the angles. By it forces on
/// corners act on sides, their whole sum, and on turns by their arms, l/2 [as Wang 2005, eq. 3.12,
/// for tangential ones].
class CornerMap {
 public:
  struct Term {
    int unknown;  ///< A side, or the number of sides + 3 cell + axis.
    double weight;
  };

  /// `free`: of the corners in O, 3 x n; `X_WO`: of the lattice's frame.
  CornerMap(const CellLattice& lattice, const HeldSides& held, const Eigen::Matrix3Xd& free,
            const Pose& X_WO);

  /// Corners at rest in the world [m].
  const Points& rest() const { return X_; }
  const Mat3& frame() const { return R_WO_; }
  /// The unknowns that move a corner along an axis of O; of held sides none.
  const Term* begin(int corner, int axis) const { return terms_.data() + first(corner, axis); }
  const Term* end(int corner, int axis) const { return terms_.data() + first(corner, axis + 1); }

  /// Corners in the world [m].
  void place(const CellState& state, Points* x) const;
  /// Those of the surface only; the others are as they were.
  void placeSurface(const CellState& state, Points* x) const;
  /// Where corner i goes in the world by what way(unknown) says of those that move it [m].
  template <class Way>
  Vec3 way(int i, const Way& way) const {
    Vec3 d = Vec3::Zero();
    for (int a = 0; a < 3; ++a) {
      for (const Term* t = begin(i, a); t != end(i, a); ++t) d[a] += t->weight * way(t->unknown);
    }
    return R_WO_ * d;
  }
  /// += what forces `f` on the corners, world, 3 x n [N], are to sides [N] and turns [N m].
  void pull(const Points& f, Eigen::VectorXd* sides, Eigen::VectorXd* turns) const;
  /// Of forces on corners the sum that no side takes: held ones bear it; in world [N].
  Vec3 borne(const Points& f) const;
  /// The sides and turns that place corners as near to x, 3 x n [m], as they can; no pressures.
  void fit(const Points& x, CellState* state) const;

 private:
  std::size_t first(int corner, int axis) const {
    return static_cast<std::size_t>(first_[static_cast<std::size_t>(3 * corner + axis)]);
  }
  int num_sides_;
  Points X_;
  Mat3 R_WO_;
  double arm_;  // by which turns count [m]
  std::vector<Term> terms_;
  std::vector<int> first_;
  std::vector<int> surface_;  // corners of triangles, ascending
};

}  // namespace palpate::tissue
