// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fem_body.h"

namespace palpate::tissue {

/// The contact's part of an explicit step, taken implicitly: positions y of the touched nodes with
///
///   c_i (y_i - x_i) = contact forces at y,   c_i [kg/s^2] the mass over the square of the step,
///
/// so a stiff response does not bound the step [implicit-explicit: Eberhardt et al. 2000, of stiff
/// springs]. Newton's method on these nodes only; what of the responses' stiffness is not
/// semidefinite enters its systems where it is small against c, so that they are positive definite;
/// they are solved by conjugate gradients.
class ContactUpdate {
 public:
  explicit ContactUpdate(FemBody* body);

  /// Moves the touched nodes of x, 3 x n [m], from where the step would bring them without contact.
  /// `coefficients`: c, n [kg/s^2]. `tolerance` [N] of the norm of their unbalanced forces. Begins
  /// with the forces of the last time.
  void apply(const Eigen::VectorXd& coefficients, double tolerance, Points* x);
  /// Afterwards: lets none of these nodes go farther than `longest` [m] from `begin`, 3 x n [m]:
  /// tissue that a tool is deep in is pushed out in several steps. False if it held one back.
  bool limit(const Eigen::VectorXd& coefficients, const Points& begin, double longest, Points* x);
  /// No contact: forgets forces and nodes.
  void clear();

  /// Nodes that apply() may have moved.
  const std::vector<int>& nodes() const { return nodes_; }
  /// Minus the contact forces at the end of apply(), 3 x n [N]; zero but at nodes().
  const Points& gradient() const { return gradient_; }
  /// How deep the deepest point is in a tool [m].
  double deepest() const { return deepest_; }
  /// Of Newton's method in apply().
  int iterations() const { return iterations_; }
  /// Norm of the unbalanced forces that apply() left [N].
  double residual() const { return residual_; }

 private:
  void touch(int node, const Points& x);
  void warmStart(const Eigen::VectorXd& coefficients, Points* x);
  void collect(const Points& x);
  void linearise(const Eigen::VectorXd& coefficients);
  double unbalanced(const Eigen::VectorXd& coefficients, const Points& x);
  void solve(const Eigen::VectorXd& coefficients);
  void go(const Eigen::VectorXd& coefficients, Points* x);
  void turnBack(const Eigen::VectorXd& coefficients, Points* x);
  double energy(const Eigen::VectorXd& coefficients, const Points& x) const;
  void multiply(const Eigen::VectorXd& coefficients, const Points& d, Points* Ad) const;

  FemBody& body_;
  std::vector<contact::Contact> contacts_;
  std::vector<Mat3> stiffness_, exact_;  // of the contacts [N/m]
  std::vector<int> nodes_;
  std::vector<char> touched_;  // n
  Points gradient_;            // 3 x n
  // 3 x n, of which only the columns of nodes_ are in use.
  Eigen::VectorXd curvature_;  // n [N/m], of the touched nodes
  Points free_x_, right_, step_, r_, p_, Ap_, inverse_diagonal_;
  std::vector<int> last_nodes_;
  double residual_ = 0.0, deepest_ = 0.0;
  int iterations_ = 0;
};

}  // namespace palpate::tissue
