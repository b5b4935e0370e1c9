// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "linear_part.h"
#include "palpate/fem/energy_term.h"

namespace palpate::tissue {

/// The points A of a linear part's surface that tools may touch, as unknowns. In balance with all
/// others of the surface they have the energy
///
///   1/2 r^T Q r,   r = u_A - a_A - T_A u_c,   Q = C_AA^-1,
///
/// of which Q r are the forces that they need. The other points of the surface are pinned: each by
/// the stiffness D that it has alone, where it was put last, which so exerts nothing until it is
/// put elsewhere.
class TouchedSurface {
 public:
  explicit TouchedSurface(const LinearPart* part);

  /// A: those of these points of the body, ascending, that are of the surface. False: as before.
  bool set(const std::vector<int>& nodes);
  /// Where they are pinned from now on: at x, 3 x n [m].
  void pin(const Points& x);
  /// Energy at x [J], where the kept points' displacements are u_c; g += its gradient. `back`:
  /// whether the kept points feel it.
  double addGradient(const Points& x, const Eigen::VectorXd& u_c, bool back, Points* g);
  /// D of all points of the surface.
  void addPins(fem::BlockMatrix* K) const;
  /// What the second derivative has beside.
  void addHessian(bool back, fem::Stiffness* K) const;

  /// Places of A in LinearPart::surface(), and the forces at x on them, 3 each [N].
  const std::vector<int>& places() const { return places_; }
  Eigen::Ref<const Eigen::VectorXd> forces(const Points& x, const Eigen::VectorXd& u_c);

 private:
  void invert();
  void multiplyOut();

  const LinearPart& part_;
  std::vector<int> place_of_;  // of the body's points in the surface, or -1
  std::vector<Mat3> pins_;     // D
  Points pinned_;              // 3 x p
  std::vector<char> touched_;  // p
  std::vector<int> places_, next_;
  Eigen::VectorXi nodes_;  // of the second derivative: A, then kept ones
  std::vector<double> Q_memory_, H_memory_, T_memory_;
  Eigen::VectorXd r_, e_, on_kept_;
  Eigen::Index size_ = 0;  // 3 |A|
};

}  // namespace palpate::tissue
