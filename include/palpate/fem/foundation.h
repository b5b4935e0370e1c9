// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "palpate/fem/energy_term.h"
#include "palpate/fem/supports.h"

namespace palpate::fem {

/// What springs and dashpots spread over a surface exert on its area, along its normal and along
/// the surface.
struct FoundationConstants {
  double normal = 0.0, tangential = 0.0;                  ///< [Pa/m]
  double normal_damping = 0.0, tangential_damping = 0.0;  ///< [Pa s/m]

  bool damped() const { return normal_damping > 0.0 || tangential_damping > 0.0; }
};

/// An elastic foundation [Winkler 1867]: each area of a surface is drawn back to its anchor, with a
/// force that grows with its distance alone. Lumped at the nodes: node a, which has the area A_a =
/// integral of N_a and the normal n_a of the surface at rest, has the energy
///
///   A_a/2 (k_n (n . e)^2 + k_t |e - n (n . e)|^2),   e = x_a - anchor_a
///
/// and, in a step of h from e_0, dashpots by backward Euler: the same with c_n/h, c_t/h and e -
/// e_0.
class Foundation final : public EnergyTerm {
 public:
  /// Anchored where `faces`, 3 x k or 6 x k, are in X, 3 x n.
  Foundation(const Points& X, const Eigen::MatrixXi& faces, const FoundationConstants& constants);

  /// The anchors are where they were at rest, moved by `offset` [m].
  void moveAnchors(const Vec3& offset) { offset_ = offset; }
  const Vec3& offset() const { return offset_; }
  /// Begins a step of `h` [s], infinity: without damping, from x with the anchors where they are.
  void beginStep(double h, const Points& x);

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, Tangent tangent, Stiffness* K) const override;

  /// Directions in which nodes are held by springs.
  void addHeldDirections(std::vector<HeldDirection>* held) const;
  /// Bound of the square of the frequency of its springs alone on these masses, n [1/s^2].
  double largestSquare(const Eigen::VectorXd& masses) const;

 private:
  struct Node {
    int node;
    double area;          // [m^2]
    Vec3 anchor;          // at rest
    Mat3 spring, damper;  // times the area [N/m], [N s/m]
  };
  bool damps() const { return damped_ && h_ < std::numeric_limits<double>::infinity(); }

  FoundationConstants constants_;
  bool damped_;
  std::vector<Node> nodes_;
  std::vector<Vec3> begin_;  // e_0 of each [m]
  Vec3 offset_ = Vec3::Zero();
  double h_ = std::numeric_limits<double>::infinity();
};

}  // namespace palpate::fem
