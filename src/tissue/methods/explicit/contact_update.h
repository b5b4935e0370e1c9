// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "tissue/body/fem_body.h"

namespace palpate::tissue {

/// Implicit contact in an explicit step. Solves for positions y of the touched nodes with
///
///   c_i (y_i - x_i) = contact forces at y,   c_i [kg/s^2] the mass over the square of the step,
///
/// so the contact stiffness does not bound the step [implicit-explicit: Eberhardt et al. 2000, of
/// stiff springs]. Newton's method on these nodes, with conjugate gradients. Indefinite parts of
/// the contact stiffness are included where small against c, so that systems are positive definite.
class ContactUpdate {
 public:
  explicit ContactUpdate(FemBody* body);

  /// Moves the touched nodes of x, 3 x n [m], from the positions without contact to y.
  /// `coefficients`: c, n [kg/s^2]; `tolerance`: of the residual [N]. Warm start with the forces of
  /// the last call.
  void apply(const Eigen::VectorXd& coefficients, double tolerance, Points* x);
  /// Limits the displacement of nodes() from `begin`, 3 x n [m], to `longest` [m], so that deep
  /// penetration is resolved over several steps. Returns false where a node was limited.
  /// @pre apply().
  bool limit(const Eigen::VectorXd& coefficients, const Points& begin, double longest, Points* x);
  /// Clears forces and nodes: no contact.
  void clear();

  /// Nodes that apply() may have moved.
  const std::vector<int>& nodes() const { return nodes_; }
  /// Minus the contact forces at the end of apply(), 3 x n [N]; zero but at nodes().
  const Points& gradient() const { return gradient_; }
  /// Largest penetration [m].
  double deepest() const { return deepest_; }
  /// Newton iterations of apply().
  int iterations() const { return iterations_; }
  /// Residual of apply() [N].
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
