// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact_update.h"
#include "fem_body.h"

namespace palpate::tissue {

/// How tools meet a body that goes in explicit steps: in each, the tools go on by a part of their
/// way, and touched nodes end where a ContactUpdate has them.
class ExplicitContact {
 public:
  /// A tool goes no farther in a step than this part of its inscribed radius and of an element,
  /// unless it leaps.
  static constexpr double kToolWay = 0.25;

  explicit ExplicitContact(FemBody* body);

  /// How many steps the tools' ways in this cycle ask for.
  double steps() const;
  /// A cycle begins: with the tools where they begin, and without contact.
  void begin();
  /// A step from body.x by the way `next`, in which the tools go on to part `s` of theirs: makes
  /// `next` the positions at its end, 3 x n [m]. `coefficients`: as for ContactUpdate::apply().
  /// False: tissue would have gone through a tool, and `next` is of no use.
  bool step(double s, const Eigen::VectorXd& coefficients, Points* next);
  /// No contact, for what moves is stopped or set from outside.
  void clear() { update_.clear(); }

  /// Nodes that the last step() may have moved.
  const std::vector<int>& nodes() const { return update_.nodes(); }
  /// Minus the contact's forces, 3 x n [N].
  const Points& gradient() const { return update_.gradient(); }
  /// That the last step() took for one answer of the contacts, at most.
  int iterations() const { return iterations_; }
  /// Norm of the forces that it left unbalanced [N].
  double residual() const { return update_.residual(); }
  /// How far the fastest tool went in it [m].
  double toolWay() const { return tool_way_; }
  /// Whether it held nodes back that would have gone too far at once: a tool has leapt into them,
  /// and they are not out of it.
  bool limited() const { return limited_; }
  /// Of a cycle that ends with the last step(), or `late`, with sub-steps left. `tolerance` [N].
  solver::SolveStatus status(double tolerance, bool late) const;
  /// Cube root of the volume of a node [m].
  double elementSize() const { return element_size_; }

 private:
  bool mayJump(const Points& way) const;
  void answer(const Eigen::VectorXd& coefficients, Points* next);

  FemBody& body_;
  double element_size_;
  ContactUpdate update_;
  Points untouched_;  // where friction may ask for another answer
  int iterations_ = 0;
  bool limited_ = false;                // it held nodes back that would have gone too far at once
  bool friction_converged_ = true;      // it found friction within Coulomb's law
  double part_ = 0.0, tool_way_ = 0.0;  // of the tools' way, where they are
};

}  // namespace palpate::tissue
