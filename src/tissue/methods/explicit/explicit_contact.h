// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact_update.h"
#include "tissue/body/fem_body.h"

namespace palpate::tissue {

/// Contact of tools in explicit steps: each sub-step moves the tools by a fraction of their path,
/// then a ContactUpdate moves the touched nodes.
class ExplicitContact {
 public:
  /// Largest tool displacement per sub-step, relative to the lesser of inscribed radius and element
  /// size [-].
  static constexpr double kToolWay = 0.25;

  explicit ExplicitContact(FemBody* body);

  /// Number of sub-steps that kToolWay requires in this cycle.
  double steps() const;
  /// Begins a cycle: tools at the begin of their path, no contact.
  void begin();
  /// Computes a sub-step from body.x by the displacement `next`, 3 x n [m], with the tools moved to
  /// fraction `s` of their path; `next` becomes the positions at its end. `coefficients`: as in
  /// ContactUpdate::apply(). Returns false where tissue would pass through a tool; `next` is then
  /// invalid.
  bool step(double s, const Eigen::VectorXd& coefficients, Points* next);
  /// Clears contact: the body was stopped or its positions were set.
  void clear() { update_.clear(); }

  /// Nodes that contact may have moved in the last step().
  const std::vector<int>& nodes() const { return update_.nodes(); }
  /// Gradient of the contact energy, 3 x n [N].
  const Points& gradient() const { return update_.gradient(); }
  /// Most Newton iterations of a contact solve in the last step().
  int iterations() const { return iterations_; }
  /// Residual of contact in the last step() [N].
  double residual() const { return update_.residual(); }
  /// Largest tool displacement in the last step() [m].
  double toolWay() const { return tool_way_; }
  /// Whether the last step() limited the displacement of nodes, after a tool jumped into tissue.
  bool limited() const { return limited_; }
  /// Status of a cycle that ends with the last step(); `late`: with sub-steps left; `tolerance`
  /// [N].
  solver::SolveStatus status(double tolerance, bool late) const;
  /// Cube root of the volume of a node [m].
  double elementSize() const { return element_size_; }

 private:
  bool mayJump(const Points& way) const;
  void answer(const Eigen::VectorXd& coefficients, Points* next);

  FemBody& body_;
  double element_size_;
  ContactUpdate update_;
  Points untouched_;  // positions without contact, for augmentation
  int iterations_ = 0;
  bool limited_ = false;                // whether node displacements were limited
  bool friction_converged_ = true;      // whether friction obeys Coulomb's law
  double part_ = 0.0, tool_way_ = 0.0;  // of the tool path; displacement [m]
};

}  // namespace palpate::tissue
