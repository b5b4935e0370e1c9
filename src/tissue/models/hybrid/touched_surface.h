// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "linear_part.h"
#include "palpate/fem/energy_term.h"

namespace palpate::tissue {

/// Touchable surface points A of a linear part, as unknowns. In equilibrium with the other surface
/// points their energy is
///
///   1/2 r^T Q r,   r = u_A - a_A - T_A u_c,   Q = C_AA^-1,
///
/// with forces Q r. Other surface points are pinned at their last positions by their own stiffness
/// D, without force there.
class TouchedSurface {
 public:
  explicit TouchedSurface(const LinearPart* part);

  /// Sets A to the surface points among these points of the body, ascending. Returns whether A
  /// changed.
  bool set(const std::vector<int>& nodes);
  /// Pins the points at x, 3 x n [m].
  void pin(const Points& x);
  /// Energy at x [J], where the kept points' displacements are u_c; g += its gradient. `back`:
  /// whether forces act on kept points.
  double addGradient(const Points& x, const Eigen::VectorXd& u_c, bool back, Points* g);
  /// Stiffness D of all surface points [N/m].
  void addPins(fem::BlockMatrix* K) const;
  /// Adds the dense second derivative over A and the kept points.
  void addHessian(bool back, fem::Stiffness* K) const;

  /// Indices of A in LinearPart::surface(), and forces on them at x, 3 each [N].
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
