// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fem_body.h"
#include "palpate/solver/newton.h"
#include "surface_compliance.h"

namespace palpate::tissue {

/// Contact with a body that is a compliance C: the nodal forces f with
///
///   f = contact forces at X + u0 + C f,
///
/// the minimum of 1/2 f . C f + the contact's energy. Newton's method on the candidates' nodes;
/// its systems (1 + C H) d = -C r are dense and only as large as the nodes that are touched.
class CompliantContact {
 public:
  CompliantContact(FemBody* body, const SurfaceCompliance* compliance);

  /// Improves the forces `f` (3 x n [N], zero but where contact is) and the candidates' nodes of x,
  /// 3 x n [m]. `u0`: displacements without contact, 3 x n [m].
  solver::NewtonReport solve(const Points& u0, double tolerance, int max_iterations, Points* f,
                             Points* x);

 private:
  void gatherNodes(const Points& u0, Points* f, Points* x);
  void linearise(const Points& x, bool exact);
  bool direction();
  bool lineSearch(Points* x);
  double energy(const Eigen::VectorXd& f, const Eigen::VectorXd& u, const Points& x) const;
  void scatter(const Eigen::VectorXd& u, Points* x) const;

  FemBody& body_;
  const SurfaceCompliance& compliance_;
  std::vector<contact::Contact> contacts_;
  std::vector<int> nodes_, local_;  // candidates' nodes that can move; n: where in them, or -1
  std::vector<int> touched_, touched_at_;  // of nodes_; where in touched_, or -1
  Eigen::MatrixXd C_, H_, system_;
  Eigen::VectorXd f_, u_, u0_, r_, free_;  // of nodes_
  Eigen::VectorXd du_, df_, trial_f_, trial_u_;
  Points step_, trial_x_;  // 3 x n
};

}  // namespace palpate::tissue
