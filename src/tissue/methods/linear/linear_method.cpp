// SPDX-License-Identifier: GPL-3.0-or-later
#include "linear_method.h"

#include "tissue/touch/stage_limits.h"

namespace palpate::tissue {

LinearMethod::LinearMethod(FemBody* body)
    : body_(*body),
      compliance_(body->elasticity.get(), body->free, body->mesh.points, body->triangles,
                  &body->surroundings),
      contact_(&body->contact, body->mesh.points, body->free, compliance_.ofNodes()),
      force_(Points::Zero(3, body->x.cols())) {
  loads_ = body_.gravity.forces();
  if (!body_.drive.loads.empty()) {
    loads_.setZero();
    body_.addLoads(body_.mesh.points, &loads_);
    loads_ = -loads_;
  }
  compliance_.solve(loads_, &u_loads_);
  u0_ = u_loads_;
}

void LinearMethod::moveToEquilibrium(Points* x) { *x = body_.mesh.points + u0_; }

// Contact forces at the present positions, after these were set.
void LinearMethod::restart() {
  u_ = body_.x - body_.mesh.points;
  compliance_.multiply(u_, &force_);
  force_ = (force_ - loads_).cwiseProduct(body_.free);
  for (Eigen::Index i = 0; i < force_.cols(); ++i) {
    if (compliance_.find(static_cast<int>(i)) < 0) force_.col(i).setZero();
  }
  compliance_.multiply(u_, &g_);
  energy_ = elasticEnergy(u_, g_);
}

void LinearMethod::save(StateWriter* out) const {
  out->put(force_);
  out->put(residual_);
  out->put(energy_);
}

void LinearMethod::restore(StateReader* in) {
  in->getSame(&force_);
  in->get(&residual_);
  in->get(&energy_);
}

bool LinearMethod::advance(double dt, TissueStep* out) {
  x_begin_ = body_.x;
  force_begin_ = force_;
  out->tolerance = body_.tolerance();
  out->sweep_stages = 0;
  solver::NewtonReport solved;
  StateWriter touched;
  body_.contact.save(&touched);
  body_.tool_path.moveTo(0.0);
  body_.tool_path.beginStep(body_.x);
  for (double s = 0.0; s < 1.0;) {
    {
      const PhaseTimer timer(&out->phases, Phase::kContact);
      s = body_.tool_path.next(body_.x, s, 1.0);
      ++out->sweep_stages;
      body_.tool_path.moveTo(s);
    }
    moveHeld(s);
    solved = solveStage(s < 1.0, out);
    if (solved.status == solver::SolveStatus::kDeadline) {
      body_.tool_contact.inside_tools.invalidate();
      break;
    }
    const int most = body_.contact.hasFriction() ? kMaxFrictionAugmentations : kMaxAugmentations;
    for (int k = 0; s == 1.0 && k < most; ++k) {
      if (solved.status != solver::SolveStatus::kConverged ||
          body_.contact.augmentationConverged(body_.x))
        break;
      body_.contact.augment(body_.x);
      solved = solveStage(false, out);
    }
  }
  out->status = solved.status;
  if (!body_.x.allFinite() || !solver::usable(out->status)) {
    body_.x = x_begin_;
    force_ = force_begin_;
    StateReader before(touched.bytes());
    body_.contact.restore(&before);
    return false;
  }
  out->satisfied = out->newton_iterations == 0;
  const PhaseTimer timer(&out->phases, Phase::kForces);
  body_.v = (body_.x - x_begin_) / dt;
  balance();
  body_.contact.endStep(body_.x);
  if (out->ok()) body_.contact.learn(body_.x, dt);
  out->residual = residual_;
  return true;
}

// Computes displacements without contact: by loads, prescribed nodes and moved anchors.
void LinearMethod::moveHeld(double s) {
  body_.surroundings.moveTo(s);
  if (!body_.heldMoves() && !body_.surroundings.moves()) return;
  Points way = Points::Zero(3, body_.x.cols());
  if (body_.drive.held) {
    way = (body_.drive.held(s) - body_.mesh.points).array() * (1.0 - body_.free.array());
  } else {
    body_.surroundings.carry(s, body_.mesh.points, &way);
  }
  compliance_.multiply(way, &g_);
  addAnchorForces(&g_);
  compliance_.solve(-g_, &u0_);
  u0_ += u_loads_ + way;
}

// Adds forces of moved anchors at rest positions; the compliance has the springs' stiffness.
void LinearMethod::addAnchorForces(Points* g) const {
  if (!body_.surroundings.moves()) return;
  for (const fem::EnergyTerm* t : body_.surroundings.terms()) t->addGradient(body_.mesh.points, g);
}

// Elastic energy of displacements u with the gradient g of all stiffness [J].
double LinearMethod::elasticEnergy(const Points& u, const Points& g) const {
  double twice = u.cwiseProduct(g).sum();
  if (body_.surroundings.empty()) return 0.5 * twice;
  Points there = Points::Zero(3, u.cols()), here = there;
  for (const fem::EnergyTerm* t : body_.surroundings.terms()) {
    t->addGradient(body_.mesh.points + u, &there);
    t->addGradient(body_.mesh.points, &here);
  }
  twice -= u.cwiseProduct(there - here).sum();
  return 0.5 * twice;
}

solver::NewtonReport LinearMethod::solveStage(bool on_the_way, TissueStep* out) {
  const double tolerance = (on_the_way ? kStageTolerance : 1.0) * 0.5 * out->tolerance;
  solver::NewtonReport solved;
  const PhaseTimer timer(&out->phases, Phase::kLinearSolve);
  for (int search = 0; search < kMaxSearches; ++search) {
    solved = contact_.solve(u0_, tolerance, body_.settings.max_newton_iterations, &force_, &body_.x,
                            body_.interrupt);
    out->newton_iterations += solved.iterations;
    if (force_.isZero(0.0)) {
      body_.x = body_.mesh.points + u0_;
    } else {
      compliance_.solve(force_, &u_);
      body_.x = body_.mesh.points + u0_ + u_;
    }
    if (body_.tool_path.candidatesHold(body_.x)) break;
    body_.tool_path.search(body_.x);
  }
  return solved;
}

// Computes the gradient of all energies at x, the residual, and the elastic energy.
void LinearMethod::balance() {
  u_ = body_.x - body_.mesh.points;
  compliance_.multiply(u_, &g_);
  energy_ = elasticEnergy(u_, g_);
  g_ -= loads_;
  addAnchorForces(&g_);
  body_.contact.addGradient(body_.x, &g_);
  residual_ = g_.cwiseProduct(body_.free).norm();
}

void LinearMethod::reportForces(TissueStep* out) {
  body_.reportSupport(g_, out);
  body_.reportContacts(out);
}

}  // namespace palpate::tissue
