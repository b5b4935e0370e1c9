// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "body_motion.h"
#include "palpate/solver/joint_potential.h"
#include "palpate/tissue/interaction.h"

namespace palpate::tissue {

/// Interaction of two members, by their indices, or of one with itself.
struct MemberInteraction {
  InteractionTerm* term;
  std::size_t a, b;
  double way;  ///< Argument of InteractionTerm::search() [m].

  bool operator==(const MemberInteraction& o) const {
    return term == o.term && a == o.a && b == o.b;
  }
};

/// Bodies of one implicit solve: the members of a group, with their interactions. Points are
/// concatenated by member; those of a single body are the body's own.
class StepGroup {
 public:
  /// A single body without interactions; its potential is the body's own.
  /// @pre `body` outlives this.
  explicit StepGroup(BodyMotion* body)
      : members_{body},
        bodies_{&body->body()},
        potential_(&body->potential()),
        x_(&body->body().x),
        first_{0} {}
  /// A group that may have interactions.
  /// @pre All members have the same scene settings and outlive this.
  explicit StepGroup(const std::vector<BodyMotion*>& members);
  StepGroup(const StepGroup&) = delete;  // x_ may refer to all_x_
  StepGroup& operator=(const StepGroup&) = delete;

  /// Sets the interactions.
  /// @pre Made as a group that may have them.
  void setInteractions(const std::vector<MemberInteraction>& interactions);

  const FemSettings& settings() const { return bodies_.front()->settings; }
  const solver::Interrupt* interrupt() const { return bodies_.front()->interrupt; }
  const solver::Potential& potential() const { return *potential_; }
  /// Positions in the present step, 3 x n [m].
  Points& x() { return *x_; }
  /// Columns of `all` that belong to a member.
  const Points& part(std::size_t member, const Points& all) const;

  /// Tolerance of the residual: the least of the members', as if each was alone [N].
  double tolerance() const;
  /// Tolerance by the forces at x instead of the last cycle's [N]; `gradient`: of the potential at
  /// x, 3 x n [N].
  double toleranceHere(const Points& gradient);
  /// Lower bound of both tolerances [N].
  double leastTolerance() const;
  void beginCycle();
  void goBack();
  void endCycle();
  /// Begins a step of `h` [s] at x and fraction `begin` of the cycle. Returns whether the scale of
  /// the elastic stiffness differs from the group's last step.
  bool beginStep(double begin, double h);
  /// Ends the step with the total residual `unbalanced` [N].
  void endStep(double unbalanced);
  void extrapolate(double h, Points* way);
  /// Whether boundary conditions carry nodes; moveSurroundings() moves these and spring anchors to
  /// fraction `s` of the cycle.
  bool carries() const;
  void moveSurroundings(double s);
  /// Sets the carried nodes of `all`, or of x at a step's begin, to fraction `s`.
  void carryTo(double s, Points* all) const;
  void carryHere(double s);
  /// Value of the potential at x, a step's begin [J].
  double valueHere();
  /// Activates the inversion barriers of bodies with nearly inverted elements at x. Returns whether
  /// one was activated: solve again. A barrier ends when a cycle begins without such elements.
  bool startGuarding();
  /// Whether elements are inverted at x.
  bool inverted();
  /// See FemBody::heldWay().
  bool heldWay(double s, Points* way);
  /// See BodyMotion::squaredUnbalancedForce().
  double unbalancedForce(const Points& gradient);

  // Tool path, as in ToolPath.
  void moveTools(double s);
  // StepHooks of tool contact and interactions, at x.
  void beginTouches();
  double nextStage(double s, double end);
  bool pushTo(double s, const Points& all, Points* push);
  /// Marks inside tools as unverified: tools moved without a solve.
  void invalidateInsideTools();
  bool candidatesHold();
  bool augmentationConverged();
  void augment();
  void learn(double h);
  /// Finds the candidates of tool contact and interactions at x.
  void search();
  bool hasFriction() const;

  /// Forces of the other members on each member at the end of the last step.
  const std::vector<InteractionForce>& interactionForces() const { return interaction_forces_; }

  /// State of the group in addition to the members'.
  void save(StateWriter* out) const { out->put(scales_); }
  void restore(StateReader* in) { in->get(&scales_); }

 private:
  struct MappedInteraction {
    MemberInteraction what;
    std::vector<const fem::EnergyTerm*> terms;  // with one element
    std::unique_ptr<solver::MappedTerms> of_all;
    Points x;  // points of the pair
  };

  template <class Visit>
  void forInteractions(const Visit& visit) const;
  template <class Visit>
  void forHooks(const Visit& visit);
  template <class Fill>
  bool fillParts(Points* all, const Fill& fill);
  const std::vector<FemBody*>& bodiesAtX();
  void takeX();
  void endGuarding();
  void searchInteractions();
  void sumInteractionForces();

  std::vector<BodyMotion*> members_;
  std::vector<FemBody*> bodies_;                   // of the members
  std::unique_ptr<solver::JointPotential> joint_;  // null: never interactions
  const solver::Potential* potential_;             // of joint_, or of the body
  Points* x_;                                      // all_x_, or of the body
  std::vector<int> first_;                         // first column in x of each member
  std::vector<std::unique_ptr<MappedInteraction>> interactions_;
  std::vector<double> scales_;
  StateWriter before_;  // of tool contact and interactions, at the cycle's begin
  Points all_x_;
  mutable std::vector<Points> parts_;  // buffers of part()
  Points filled_;                      // buffer of fillParts()
  Points gradient_;                    // of the interactions
  std::vector<InteractionForce> interaction_forces_;
};

}  // namespace palpate::tissue
