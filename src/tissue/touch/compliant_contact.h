// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/contact_potential.h"
#include "palpate/fem/supports.h"
#include "palpate/solver/interrupt.h"
#include "palpate/solver/newton.h"

namespace palpate::tissue {

/// Compliance of surface nodes: displacement of node a by a unit force at node b is the 3 x 3 block
/// (index[a], index[b]) of `matrix` [m/N], symmetric. The index is -1 for other nodes.
struct NodeCompliance {
  const std::vector<int>& index;
  const Eigen::MatrixXd& matrix;
};

/// Contact with a body of compliance C [m/N]. Solves for the nodal forces f [N]:
///
///   f = contact forces at X + u0 + C f,
///
/// the minimum of 1/2 f . C f + the contact's energy. Newton's method on the candidates' nodes with
/// dense systems (1 + C H) d = -C r over the touched nodes. Allocates only to grow its buffers.
class CompliantContact {
 public:
  /// `X`: rest positions, 3 x n [m]. @pre All arguments outlive this.
  CompliantContact(contact::ContactPotential* contact, const Points& X, const fem::FreeMask& free,
                   const NodeCompliance& compliance);

  /// Solves for the forces `f`, 3 x n [N], and the candidates' nodes of x, 3 x n [m], from their
  /// present values. `u0`: displacements without contact, 3 x n [m]. `interrupt` may be null.
  solver::NewtonReport solve(const Points& u0, double tolerance, int max_iterations, Points* f,
                             Points* x, const solver::Interrupt* interrupt = nullptr);

 private:
  // Of the candidates' nodes.
  enum Vector { kF, kU, kU0, kR, kFree, kStepU, kStepF, kTrialF, kTrialU, kNumVectors };
  auto of(Vector name) { return vectors_.col(name).head(size_); }
  auto of(Vector name) const { return vectors_.col(name).head(size_); }
  using Square = Eigen::Map<Eigen::MatrixXd>;
  static Square square(Eigen::Index size, std::vector<double>* memory);

  // Block of nodes_[a] and nodes_[b] [m/N].
  auto compliance(std::size_t a, std::size_t b) const {
    return compliance_.matrix.block<3, 3>(3 * compliance_.index[nodes_[a]],
                                          3 * compliance_.index[nodes_[b]]);
  }

  void gatherNodes(const Points& u0, Points* f, Points* x);
  void linearise(const Points& x, bool exact);
  void addStiffness(const contact::Touch& touch, const Mat3& stiffness);
  bool direction();
  bool lineSearch(Points* x);
  double energy(Vector f, Vector u, const Points& x) const;
  void addMotion(Vector f, Vector u);
  void scatter(Vector u, Points* x) const;

  contact::ContactPotential& contact_;
  const Points& X_;
  const fem::FreeMask& mask_;
  NodeCompliance compliance_;
  std::vector<contact::Contact> contacts_;
  std::vector<int> nodes_, local_;  // candidates' nodes that can move; n: where in them, or -1
  std::vector<int> touched_, touched_at_;  // of nodes_; where in touched_, or -1
  Eigen::Index size_ = 0;                  // 3 nodes_.size()
  Eigen::MatrixXd vectors_ = Eigen::MatrixXd(0, kNumVectors);  // a column each
  std::vector<double> H_memory_, system_memory_, right_;
  Points step_, trial_x_;  // 3 x n
};

}  // namespace palpate::tissue
