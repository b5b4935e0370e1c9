// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "body_motion.h"
#include "palpate/solver/joint_potential.h"
#include "palpate/tissue/interaction.h"

namespace palpate::tissue {

/// An interaction between two members, by their numbers, or within one.
struct MemberInteraction {
  InteractionTerm* term;
  std::size_t a, b;
  double way;  ///< See InteractionTerm::search() [m].

  bool operator==(const MemberInteraction& o) const {
    return term == o.term && a == o.a && b == o.b;
  }
};

/// What implicit steps move as one: a body, or the members of a group with what acts between them.
/// Points are those of one member after another; of a single body they are its own.
class StepGroup {
 public:
  explicit StepGroup(BodyMotion* body) : members_{body} {}
  /// A group. All members have the same settings of the scene, and outlive this.
  explicit StepGroup(const std::vector<BodyMotion*>& members);

  /// What acts between the members of a group from here on.
  void setInteractions(const std::vector<MemberInteraction>& interactions);

  const std::vector<BodyMotion*>& members() const { return members_; }
  const FemSettings& settings() const { return members_.front()->body().settings; }
  const solver::Interrupt* interrupt() const { return members_.front()->body().interrupt; }
  const solver::Potential& potential() const {
    return joint_ ? joint_->all() : members_.front()->potential();
  }
  fem::Stiffness makeMatrix() const;
  /// Where they are in the step under way, 3 x n [m].
  Points& x() { return joint_ ? x_ : members_.front()->body().x; }
  /// The columns of `all` that are those of a member.
  const Points& part(std::size_t member, const Points& all) const;

  /// Newton's tolerance [N]: the least of the members', so that each of them is solved as well as
  /// it would be alone.
  double tolerance() const;
  /// The same by the forces at x instead of the last cycle's [N]; `gradient` of the potential
  /// there, 3 x n [N].
  double toleranceHere(const Points& gradient);
  /// What they are at least [N].
  double leastTolerance() const;
  void beginCycle();
  void goBack();
  void endCycle();
  /// A step of `h` [s] begins at x, at part `begin` of the cycle. True: the elastic part of the
  /// matrix is scaled otherwise than it was by a group's last step.
  bool beginStep(double begin, double h);
  /// `unbalanced` by so much [N], summed over all of them.
  void endStep(double unbalanced);
  void extrapolate(double h, Points* way) const;
  /// Whether surroundings carry nodes; they, and anchors, go to part `s` of the cycle.
  bool carries() const;
  void moveSurroundings(double s);
  /// Puts the carried nodes of `all` there, or of x, where a step begins.
  void carryTo(double s, Points* all) const;
  void carryHere(double s);
  /// The potential at x, where a step begins.
  double valueHere();
  /// Whether elements are so flat at x that the guards of their bodies have to act and did not:
  /// solve again. They rest again when a cycle begins with none so flat.
  bool startGuarding();
  /// Whether elements are turned inside out at x.
  bool inverted() const;
  /// See FemBody::heldWay().
  bool heldWay(double s, Points* way) const;
  /// See BodyMotion::squaredUnbalancedForce().
  double unbalancedForce(const Points& gradient);

  // The tools' way, see ToolPath.
  void moveTools(double s);
  /// A step begins with the tools, and what acts between members, where they are.
  void beginTouches();
  double nextStage(double s, double end) const;
  bool pushTo(double s, const Points& all, Points* push) const;
  /// The tools went on as the tissue could not follow; where they are now may be inside.
  void invalidateInsideTools();
  bool candidatesHold() const;
  bool hasFriction() const;
  /// Whether contact is content with x, a solution within the step, see
  /// ContactPotential::augment().
  bool augmentationConverged();
  void augment();
  /// A step of `h` [s] has ended with a solution.
  void learn(double h);
  void search();

  /// What the others of the group exert on each member where the last step ended.
  const std::vector<InteractionForce>& interactionForces() const { return interaction_forces_; }

  /// What a group remembers beside its members' own.
  void save(StateWriter* out) const { out->put(scales_); }
  void restore(StateReader* in) { in->get(&scales_); }

 private:
  struct MappedInteraction {
    MemberInteraction what;
    std::vector<const fem::EnergyTerm*> terms;  // its one
    std::unique_ptr<solver::MappedTerms> of_all;
    StateWriter before;  // the cycle
    Points x;            // of the pair
  };

  template <class Visit>
  void forInteractions(const Visit& visit) const;
  void endGuarding();
  void searchInteractions();
  void sumInteractionForces();

  std::vector<BodyMotion*> members_;
  std::unique_ptr<solver::JointPotential> joint_;  // null: a single body
  std::vector<std::unique_ptr<MappedInteraction>> interactions_;
  std::vector<double> scales_;
  Points x_;
  mutable std::vector<Points> parts_;  // scratch of part()
  mutable Points part_way_;
  Points gradient_;  // of the interactions alone
  std::vector<InteractionForce> interaction_forces_;
};

}  // namespace palpate::tissue
