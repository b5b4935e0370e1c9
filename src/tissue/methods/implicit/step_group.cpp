// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_group.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::tissue {
namespace {

// Margin on the barrier's threshold that activates it early [-].
constexpr double kFlat = 1.5;

}  // namespace

StepGroup::StepGroup(const std::vector<BodyMotion*>& members)
    : members_(members),
      x_(members.size() > 1 ? &all_x_ : &members.front()->body().x),
      parts_(members.size()) {
  std::vector<const solver::Potential*> potentials;
  for (BodyMotion* member : members) {
    bodies_.push_back(&member->body());
    potentials.push_back(&member->potential());
  }
  joint_ = std::make_unique<solver::JointPotential>(potentials);
  potential_ = &joint_->all();
  for (std::size_t k = 0; k < members.size(); ++k) first_.push_back(joint_->firstNode(k));
  x_->resize(3, joint_->numNodes());
}

void StepGroup::setInteractions(const std::vector<MemberInteraction>& interactions) {
  const bool same = std::equal(
      interactions.begin(), interactions.end(), interactions_.begin(), interactions_.end(),
      [](const MemberInteraction& a, const std::unique_ptr<MappedInteraction>& b) {
        return a == b->what;
      });
  if (!same) {
    interactions_.clear();
    std::vector<const fem::EnergyTerm*> further;
    for (const MemberInteraction& what : interactions) {
      Eigen::Index nodes = bodies_[what.a]->x.cols();
      if (what.a != what.b) nodes += bodies_[what.b]->x.cols();
      interactions_.push_back(std::make_unique<MappedInteraction>(
          MappedInteraction{what, {what.term}, nullptr, Points(3, nodes)}));
      MappedInteraction& mapped = *interactions_.back();
      mapped.of_all = std::make_unique<solver::MappedTerms>(
          mapped.terms, joint_->nodeMapOf(what.a, what.b), static_cast<int>(nodes));
      further.push_back(mapped.of_all.get());
    }
    joint_->setFurther(further);
  }
  for (std::size_t k = 0; k < interactions.size(); ++k) interactions_[k]->what = interactions[k];
}

// Calls visit(interaction, points of its pair).
template <class Visit>
void StepGroup::forInteractions(const Visit& visit) const {
  for (const std::unique_ptr<MappedInteraction>& mapped : interactions_) {
    mapped->of_all->gather(*x_, &mapped->x);
    visit(*mapped, mapped->x);
  }
}

// Calls visit(hooks, points of their terms) for tool contact of each member, then interactions.
template <class Visit>
void StepGroup::forHooks(const Visit& visit) {
  for (FemBody* body : bodiesAtX()) visit(body->tool_contact, body->x);
  forInteractions(
      [&](const MappedInteraction& mapped, const Points& x) { visit(*mapped.what.term, x); });
}

const Points& StepGroup::part(std::size_t member, const Points& all) const {
  if (members_.size() == 1) return all;
  parts_[member] = all.middleCols(first_[member], bodies_[member]->x.cols());
  return parts_[member];
}

// Calls fill(member, its part of all), whose part becomes zero where that returns false. Returns
// whether one returned true; else `all` is undefined.
template <class Fill>
bool StepGroup::fillParts(Points* all, const Fill& fill) {
  if (members_.size() == 1) return fill(0, all);
  bool any = false;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (!fill(k, &filled_)) continue;
    if (!any) all->setZero(3, x_->cols());
    all->middleCols(first_[k], filled_.cols()) = filled_;
    any = true;
  }
  return any;
}

// Moves the bodies to x, and returns them.
const std::vector<FemBody*>& StepGroup::bodiesAtX() {
  for (std::size_t k = 0; x_ == &all_x_ && k < bodies_.size(); ++k) {
    bodies_[k]->x = all_x_.middleCols(first_[k], bodies_[k]->x.cols());
  }
  return bodies_;
}

// Moves x to the bodies.
void StepGroup::takeX() {
  for (std::size_t k = 0; x_ == &all_x_ && k < bodies_.size(); ++k) {
    all_x_.middleCols(first_[k], bodies_[k]->x.cols()) = bodies_[k]->x;
  }
}

double StepGroup::tolerance() const {
  double least = std::numeric_limits<double>::infinity();
  for (const FemBody* body : bodies_) least = std::min(least, body->tolerance());
  return least;
}

double StepGroup::leastTolerance() const {
  double least = std::numeric_limits<double>::infinity();
  for (const FemBody* body : bodies_) least = std::min(least, body->leastTolerance());
  return least;
}

double StepGroup::toleranceHere(const Points& gradient) {
  sumInteractionForces();
  double least = std::numeric_limits<double>::infinity();
  bodiesAtX();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const double others = interaction_forces_[k].norm;
    least = std::min(least, bodies_[k]->toleranceHere(part(k, gradient), others));
  }
  return least;
}

void StepGroup::beginCycle() {
  for (BodyMotion* member : members_) member->beginCycle();
  takeX();
  before_.clear();
  forHooks([&](const StepHooks& hooks, const Points&) { hooks.save(&before_); });
  searchInteractions();
  endGuarding();
}

bool StepGroup::startGuarding() {
  bool any = false;
  for (FemBody* body : bodiesAtX()) {
    body->min_jacobian = body->elasticity->minJacobian(body->x);
    if (body->guard.active() || *body->min_jacobian >= fem::InversionGuard::kLeast) continue;
    body->guard.setActive(true);
    any = true;
  }
  if (!any) return false;
  for (FemBody* body : bodies_) body->min_jacobian.reset();  // x changes
  return true;
}

void StepGroup::endGuarding() {
  for (FemBody* body : bodies_) {
    if (!body->guard.active()) continue;
    body->guard.setActive(body->guard.least(body->x) < kFlat * fem::InversionGuard::kLeast);
  }
}

bool StepGroup::inverted() {
  bodiesAtX();
  return std::any_of(bodies_.begin(), bodies_.end(), [](const FemBody* body) {
    return body->guard.active() && body->guard.least(body->x) <= 0.0;
  });
}

void StepGroup::goBack() {
  for (BodyMotion* member : members_) member->goBack();
  takeX();
  StateReader before(before_.bytes());
  forHooks([&](StepHooks& hooks, const Points&) { hooks.restore(&before); });
}

void StepGroup::endCycle() {
  for (BodyMotion* member : members_) member->endCycle();
}

bool StepGroup::beginStep(double begin, double h) {
  for (BodyMotion* member : members_) member->beginStep(begin, h);
  return joint_ && joint_->takeScales(&scales_);
}

void StepGroup::endStep(double unbalanced) {
  bodiesAtX();
  for (BodyMotion* member : members_) member->endStep(unbalanced);
  sumInteractionForces();
  forHooks([](StepHooks& hooks, const Points& x) { hooks.endStep(x); });
}

void StepGroup::extrapolate(double h, Points* way) {
  fillParts(way, [&](std::size_t k, Points* of_member) {
    members_[k]->extrapolate(h, of_member);
    return true;
  });
}

bool StepGroup::carries() const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [](const FemBody* body) { return body->surroundings.carries(); });
}

void StepGroup::moveSurroundings(double s) {
  for (FemBody* body : bodies_) body->surroundings.moveTo(s);
}

void StepGroup::carryTo(double s, Points* all) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    bodies_[k]->surroundings.carryTo(s, all, first_[k]);
  }
}

void StepGroup::carryHere(double s) {
  carryTo(s, x_);
  for (FemBody* body : bodies_) {
    if (body->surroundings.carries()) body->elastic_energy.reset();
  }
}

double StepGroup::valueHere() {
  double sum = 0.0;
  bodiesAtX();
  for (BodyMotion* member : members_) sum += member->valueHere();
  for (const std::unique_ptr<MappedInteraction>& mapped : interactions_)
    sum += mapped->of_all->value(*x_);
  return sum;
}

bool StepGroup::heldWay(double s, Points* way) {
  bodiesAtX();
  return fillParts(
      way, [&](std::size_t k, Points* of_member) { return bodies_[k]->heldWay(s, of_member); });
}

double StepGroup::unbalancedForce(const Points& gradient) {
  double sum = 0.0;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    sum += members_[k]->squaredUnbalancedForce(part(k, gradient));
  }
  return std::sqrt(sum);
}

void StepGroup::moveTools(double s) {
  for (FemBody* body : bodies_) body->tool_contact.moveTo(s);
}

void StepGroup::beginTouches() {
  forHooks([](StepHooks& hooks, const Points& x) { hooks.beginStep(x); });
}

double StepGroup::nextStage(double s, double end) {
  double next = end;
  for (FemBody* body : bodiesAtX()) next = std::min(next, body->tool_path.next(body->x, s, end));
  return next;
}

bool StepGroup::pushTo(double s, const Points& all, Points* push) {
  return fillParts(push, [&](std::size_t k, Points* of_member) {
    return bodies_[k]->tool_path.pushTo(s, part(k, all), of_member);
  });
}

void StepGroup::invalidateInsideTools() {
  for (FemBody* body : bodies_) body->tool_contact.inside_tools.invalidate();
}

bool StepGroup::hasFriction() const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [](const FemBody* body) { return body->contact.hasFriction(); });
}

bool StepGroup::augmentationConverged() {
  bool all = true;
  forHooks([&](StepHooks& hooks, const Points& x) { all &= hooks.augmentationConverged(x); });
  return all;
}

void StepGroup::augment() {
  forHooks([](StepHooks& hooks, const Points& x) { hooks.augment(x); });
}

void StepGroup::learn(double h) {
  forHooks([&](StepHooks& hooks, const Points& x) { hooks.learn(x, h); });
}

bool StepGroup::candidatesHold() {
  bool hold = true;
  forHooks([&](const StepHooks& hooks, const Points& x) { hold = hold && hooks.holds(x); });
  return hold;
}

void StepGroup::search() {
  for (FemBody* body : bodiesAtX()) body->tool_path.search(body->x);
  searchInteractions();
}

void StepGroup::searchInteractions() {
  forInteractions([](MappedInteraction& mapped, const Points& x) {
    mapped.what.term->search(x, mapped.what.way);
  });
}

// Sums before endStep() changes the terms' state.
void StepGroup::sumInteractionForces() {
  interaction_forces_.assign(members_.size(), InteractionForce());
  if (interactions_.empty()) return;
  gradient_.setZero(3, x_->cols());
  for (const std::unique_ptr<MappedInteraction>& mapped : interactions_) {
    mapped->of_all->addGradient(*x_, &gradient_);
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const Points& nodal = part(k, gradient_);
    interaction_forces_[k] = {-nodal.rowwise().sum(), nodal.norm()};
  }
}

}  // namespace palpate::tissue
