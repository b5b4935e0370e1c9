// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_group.h"

#include <algorithm>

#include "palpate/solver/minimizer_list.h"

namespace palpate::tissue {
namespace {

std::vector<BodyMotion*> motionsOf(const std::vector<FemOrgan*>& members) {
  std::vector<BodyMotion*> motions;
  for (FemOrgan* member : members) motions.push_back(member->motion());
  return motions;
}

std::unique_ptr<solver::Minimizer> minimizerFor(const MovingBodies& bodies, ThreadPool* pool) {
  const FemSettings& of_scene = bodies.settings();
  solver::MinimizerSettings settings;
  settings.max_linear_iterations = of_scene.max_linear_iterations;
  settings.keep_stiffness = of_scene.skip.unchanged_stiffness;
  settings.pool = pool;
  settings.points = bodies.pointsAtRest();
  return solver::makeMinimizer("implicit_pcg", settings, bodies.makeMatrix());
}

}  // namespace

BodyGroup::BodyGroup(std::vector<FemOrgan*> members)
    : members_(std::move(members)),
      bodies_(motionsOf(members_)),
      steps_(&bodies_, minimizerFor(bodies_, members_.front()->body().pool)) {}

void BodyGroup::join() {
  steps_.forget();
  for (FemOrgan* member : members_) member->join();
}

void BodyGroup::step(double dt) {
  const bool sleeps = std::all_of(members_.begin(), members_.end(),
                                  [](const FemOrgan* member) { return member->sleeps(); });
  if (sleeps) {
    for (FemOrgan* member : members_) member->sleepOn();
    return;
  }
  for (FemOrgan* member : members_) member->beginTogether();
  out_.clear();
  if (!steps_.advance(dt, &out_)) {
    for (FemOrgan* member : members_) member->failTogether(out_);
  } else {
    const bool still = std::all_of(members_.begin(), members_.end(),
                                   [&](const FemOrgan* m) { return m->isStill(out_); });
    const bool at_rest = still && bodies_.unbalancedForce(steps_.gradient()) <= out_.tolerance;
    for (std::size_t k = 0; k < members_.size(); ++k) {
      members_[k]->endTogether(out_, at_rest, bodies_.part(k, steps_.gradient()),
                               bodies_.interactionForces()[k]);
    }
  }
  members_.front()->addWork(out_);
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
