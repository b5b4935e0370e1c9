// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "tissue/methods/implicit/implicit_steps.h"
#include "tissue/organ/fem_organ.h"

namespace palpate::tissue {

/// Bodies that are solved as one by Newton's method with conjugate gradients (`implicit_pcg`). The
/// matrices are block diagonal in the members' orders and coarse spaces, so a new group needs no
/// ordering or factorisation. State stays with the members, which can leave the group.
class BodyGroup final : private CycleSolver {
 public:
  /// @pre The members outlive this, and each has a motion().
  explicit BodyGroup(std::vector<FemOrgan*> members);

  /// Sets the interactions between members in this cycle.
  void setInteractions(const std::vector<MemberInteraction>& interactions) {
    bodies_.setInteractions(interactions);
  }
  /// Drops cached solver state: the group is new or was interrupted.
  void join();
  /// Solves a cycle of `dt` [s] by solveCycle().
  /// @pre All members have begun the cycle.
  void step(double dt);

  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  std::unique_ptr<solver::Minimizer> makeMinimizer();
  bool advance(double dt, TissueStep* out) override { return steps_.advance(dt, out); }
  void reportForcesOn(std::size_t member, TissueStep* out) override;
  double unbalancedForce() override { return bodies_.unbalancedForce(steps_.gradient()); }

  std::vector<FemOrgan*> members_;
  std::vector<std::unique_ptr<solver::BlockPcg>> made_;  // solvers of members without one
  StepGroup bodies_;
  ImplicitSteps steps_;
  TissueStep out_;
};

}  // namespace palpate::tissue
