// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_group.h"

#include <cmath>

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

void BodyGroup::step(double dt) {
  out_.clear();
  solveCycle(members_, this, dt, &out_);
  members_.front()->addWork(out_);
}

void BodyGroup::reportForcesOn(std::size_t member, TissueStep* out) {
  BodyMotion& motion = *members_[member]->motion();
  motion.reportForces(bodies_.part(member, steps_.gradient()), out);
  const InteractionForce& others = bodies_.interactionForces()[member];
  out->interaction_force = others.sum;
  motion.body().contact_force = std::hypot(motion.body().contact_force, others.norm);
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
