// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_group.h"

#include <algorithm>

#include "palpate/solver/newton.h"
#include "palpate/solver/pcg_or_factor.h"

namespace palpate::tissue {
namespace {

std::vector<BodyMotion*> motionsOf(const std::vector<FemOrgan*>& members) {
  std::vector<BodyMotion*> motions;
  motions.reserve(members.size());
  for (FemOrgan* member : members) motions.push_back(member->motion());
  return motions;
}

}  // namespace

BodyGroup::BodyGroup(std::vector<FemOrgan*> members)
    : members_(std::move(members)),
      bodies_(motionsOf(members_)),
      steps_(&bodies_, makeMinimizer()) {}

// Members of another method get an ordering here, and have no coarse space.
std::unique_ptr<solver::Minimizer> BodyGroup::makeMinimizer() {
  const FemSettings& of_scene = bodies_.settings();
  ThreadPool* pool = members_.front()->body().pool;
  std::vector<solver::BlockPcg*> solvers;
  solvers.reserve(members_.size());
  for (FemOrgan* member : members_) {
    solver::BlockPcg* own = member->motion()->pcg;
    if (!own) {
      const FemBody& body = member->body();
      made_.push_back(std::make_unique<solver::BlockPcg>(of_scene.max_linear_iterations, pool,
                                                         bestIsa(), body.mesh.points));
      own = made_.back().get();
      own->takePattern(body.elasticity->makeMatrix());
    }
    solvers.push_back(own);
  }
  return std::make_unique<solver::Newton>(bodies_.potential().elasticity->makeMatrix(),
                                          std::make_unique<solver::PcgOrFactor>(solver::BlockPcg(
                                              of_scene.max_linear_iterations, pool, solvers)),
                                          of_scene.skip.unchanged_stiffness, pool);
}

void BodyGroup::join() {
  steps_.forget();
  for (FemOrgan* member : members_) member->join();
}

// Returns a member whose backoff skips the cycle, and so all; null without one, or where another
// member is due for a retry. Asks every member, since each counts its cycles.
const FemOrgan* BodyGroup::frozenMember() const {
  const FemOrgan* frozen = nullptr;
  bool due = false;
  for (FemOrgan* member : members_) {
    const bool failing = member->isFailing();
    if (member->isFrozen()) {
      frozen = member;
    } else {
      due = due || failing;
    }
  }
  return due ? nullptr : frozen;
}

// Whether the group rests, by the cycle's tolerance and by that of the present forces.
bool BodyGroup::cameToRest() {
  const bool still = std::all_of(members_.begin(), members_.end(),
                                 [&](const FemOrgan* m) { return m->isStill(out_); });
  if (!still) return false;
  const double unbalanced = bodies_.unbalancedForce(steps_.gradient());
  if (unbalanced > out_.tolerance) return false;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    TissueStep now;
    members_[k]->takeForces(bodies_.part(k, steps_.gradient()), bodies_.interactionForces()[k],
                            &now);
  }
  return unbalanced <= bodies_.tolerance();
}

bool BodyGroup::isTouched() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const FemOrgan* member) { return member->isTouched(); });
}

void BodyGroup::step(double dt) {
  const bool sleeps = std::all_of(members_.begin(), members_.end(),
                                  [](const FemOrgan* member) { return member->sleeps(); });
  if (sleeps) {
    for (FemOrgan* member : members_) member->sleepOn();
    return;
  }
  if (isTouched()) {
    for (FemOrgan* member : members_) member->reached();
  }
  if (const FemOrgan* failing = frozenMember()) {
    for (FemOrgan* member : members_) member->stayFrozen(failing->failure());
    return;
  }
  for (FemOrgan* member : members_) member->beginTogether();
  out_.clear();
  if (!steps_.advance(dt, &out_)) {
    const bool for_good = std::all_of(members_.begin(), members_.end(), [&](const FemOrgan* m) {
      return m->failsForGood(out_.status);
    });
    for (FemOrgan* member : members_) member->failTogether(out_, for_good);
  } else {
    endSolved();
  }
  members_.front()->addWork(out_);
}

// Resets all members where one must be, since another may occupy its space.
void BodyGroup::endSolved() {
  const bool at_rest = cameToRest();
  const bool touched = isTouched();
  bool anew = false;
  for (FemOrgan* member : members_) anew |= !touched && member->shouldReset(out_, at_rest);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (anew) {
      members_[k]->resetWithGroup(out_, solver::SolveStatus::kInverted);
    } else {
      members_[k]->endTogether(out_, at_rest, bodies_.part(k, steps_.gradient()),
                               bodies_.interactionForces()[k]);
    }
  }
}

void BodyGroup::save(StateWriter* out) const {
  bodies_.save(out);
  steps_.save(out);
}

void BodyGroup::restore(StateReader* in) {
  bodies_.restore(in);
  steps_.restore(in);
}

}  // namespace palpate::tissue
