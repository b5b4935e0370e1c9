// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "palpate/fem/energy_term.h"
#include "palpate/fem/supports.h"

namespace palpate::fem {

/// Stiffness and damping per area of an elastic foundation, normal and tangential to the surface.
struct FoundationConstants {
  double normal = 0.0, tangential = 0.0;                  ///< [Pa/m]
  double normal_damping = 0.0, tangential_damping = 0.0;  ///< [Pa s/m]

  bool damped() const { return normal_damping > 0.0 || tangential_damping > 0.0; }
};

/// An elastic foundation [Winkler 1867]: each area of a surface is pulled to its anchor by a force
/// proportional to the distance. Node a has the area A_a = integral of N_a, the surface normal n_a
/// at rest, and the energy
///
///   A_a/2 (k_n (n . e)^2 + k_t |e - n (n . e)|^2),   e = x_a - anchor_a
///
/// For a step of h from e_0, dashpots by backward Euler add the same energy of e - e_0 with c_n/h
/// and c_t/h.
class Foundation final : public EnergyTerm {
 public:
  /// Anchors at the positions of `faces`, 3 x k or 6 x k, in X, 3 x n.
  Foundation(const Points& X, const Eigen::MatrixXi& faces, const FoundationConstants& constants);

  /// Moves the anchors by `offset` [m] from their positions at rest.
  void moveAnchors(const Vec3& offset) { offset_ = offset; }
  const Vec3& offset() const { return offset_; }
  /// Begins a step of `h` [s] from x with the present anchors; infinite h: without damping.
  void beginStep(double h, const Points& x);

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, Tangent tangent, Stiffness* K) const override;

  /// Appends the directions in which springs hold nodes.
  void addHeldDirections(std::vector<HeldDirection>* held) const;
  /// Upper bound of the squared frequency of its springs alone, for these masses, n [1/s^2].
  double largestSquare(const Eigen::VectorXd& masses) const;

 private:
  struct Node {
    int node;
    double area;          // [m^2]
    Vec3 anchor;          // at rest [m]
    Mat3 spring, damper;  // times the area [N/m], [N s/m]
  };
  bool damps() const { return damped_ && h_ < std::numeric_limits<double>::infinity(); }

  FoundationConstants constants_;
  bool damped_;
  std::vector<Node> nodes_;
  std::vector<Vec3> begin_;  // e_0 of each node [m]
  Vec3 offset_ = Vec3::Zero();
  double h_ = std::numeric_limits<double>::infinity();
};

}  // namespace palpate::fem
