// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "fem_organ.h"
#include "implicit_steps.h"

namespace palpate::tissue {

/// Bodies that are solved as one, by Newton's method with conjugate gradients (`implicit_pcg`): its
/// matrices are the members' side by side, in their orders and with their coarse spaces, so that
/// nothing is ordered or factorised when bodies come together. What members remember stays with
/// them, and each can go on alone.
class BodyGroup {
 public:
  /// The members must outlive this. All have a motion.
  explicit BodyGroup(std::vector<FemOrgan*> members);

  const std::vector<FemOrgan*>& members() const { return members_; }
  /// What acts between them in this cycle.
  void setInteractions(const std::vector<MemberInteraction>& interactions) {
    bodies_.setInteractions(interactions);
  }
  /// They come together anew: as a group that is new.
  void join();
  /// A cycle of `dt` [s], which all have begun. It sleeps if all of them would.
  void step(double dt);

  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  std::unique_ptr<solver::Minimizer> makeMinimizer();
  const FemOrgan* frozenMember() const;
  bool cameToRest();
  bool isTouched() const;
  void endSolved();

  std::vector<FemOrgan*> members_;
  std::vector<std::unique_ptr<solver::BlockPcg>> made_;  // for members that have none
  StepGroup bodies_;
  ImplicitSteps steps_;
  TissueStep out_;
};

}  // namespace palpate::tissue
