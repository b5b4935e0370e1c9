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
    : members_(members), parts_(members.size()) {
  std::vector<const solver::Potential*> potentials;
  potentials.reserve(members.size());
  for (const BodyMotion* member : members) potentials.push_back(&member->potential());
  joint_ = std::make_unique<solver::JointPotential>(potentials);
  x_.resize(3, joint_->numNodes());
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
      Eigen::Index nodes = members_[what.a]->body().x.cols();
      if (what.a != what.b) nodes += members_[what.b]->body().x.cols();
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
    mapped->of_all->gather(x_, &mapped->x);
    visit(*mapped, mapped->x);
  }
}

// Calls visit(hooks, points of their terms) for tool contact of each member, then interactions.
template <class Visit>
void StepGroup::forHooks(const Visit& visit) {
  for (std::size_t k = 0; k < members_.size(); ++k) {
    visit(members_[k]->body().tool_contact, part(k, x()));
  }
  forInteractions(
      [&](const MappedInteraction& mapped, const Points& x) { visit(*mapped.what.term, x); });
}

fem::Stiffness StepGroup::makeMatrix() const {
  return joint_ ? joint_->makeMatrix() : potential().elasticity->makeMatrix();
}

const Points& StepGroup::part(std::size_t member, const Points& all) const {
  if (!joint_) return all;
  parts_[member] = all.middleCols(joint_->firstNode(member), members_[member]->body().x.cols());
  return parts_[member];
}

double StepGroup::tolerance() const {
  double least = std::numeric_limits<double>::infinity();
  for (const BodyMotion* member : members_) least = std::min(least, member->body().tolerance());
  return least;
}

double StepGroup::leastTolerance() const {
  double least = std::numeric_limits<double>::infinity();
  for (const BodyMotion* member : members_) {
    least = std::min(least, member->body().leastTolerance());
  }
  return least;
}

double StepGroup::toleranceHere(const Points& gradient) {
  sumInteractionForces();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < members_.size(); ++k) {
    FemBody& body = members_[k]->body();
    if (joint_) body.x = part(k, x_);
    least = std::min(least, body.toleranceAt(body.x, joint_ ? part(k, gradient) : gradient,
                                             interaction_forces_[k].norm));
  }
  return least;
}

void StepGroup::beginCycle() {
  for (std::size_t k = 0; k < members_.size(); ++k) {
    members_[k]->beginCycle();
    const Points& x = members_[k]->body().x;
    if (joint_) x_.middleCols(joint_->firstNode(k), x.cols()) = x;
  }
  before_.clear();
  forHooks([&](const StepHooks& hooks, const Points&) { hooks.save(&before_); });
  searchInteractions();
  endGuarding();
}

bool StepGroup::startGuarding() {
  bool any = false;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    FemBody& body = members_[k]->body();
    body.min_jacobian = body.elasticity->minJacobian(joint_ ? part(k, x_) : body.x);
    if (body.guard.active() || *body.min_jacobian >= fem::InversionGuard::kLeast) continue;
    body.guard.setActive(true);
    any = true;
  }
  if (!any) return false;
  for (BodyMotion* member : members_) member->body().min_jacobian.reset();  // x changes
  return true;
}

void StepGroup::endGuarding() {
  for (BodyMotion* member : members_) {
    FemBody& body = member->body();
    if (!body.guard.active()) continue;
    body.guard.setActive(body.guard.least(body.x) < kFlat * fem::InversionGuard::kLeast);
  }
}

bool StepGroup::inverted() const {
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const FemBody& body = members_[k]->body();
    if (!body.guard.active()) continue;
    if (body.guard.least(joint_ ? part(k, x_) : body.x) <= 0.0) return true;
  }
  return false;
}

void StepGroup::goBack() {
  for (std::size_t k = 0; k < members_.size(); ++k) {
    members_[k]->goBack();
    const Points& x = members_[k]->body().x;
    if (joint_) x_.middleCols(joint_->firstNode(k), x.cols()) = x;
  }
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
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (joint_) members_[k]->body().x = part(k, x_);
    members_[k]->endStep(unbalanced);
  }
  sumInteractionForces();
  forHooks([](StepHooks& hooks, const Points& x) { hooks.endStep(x); });
}

void StepGroup::extrapolate(double h, Points* way) const {
  if (!joint_) return members_.front()->extrapolate(h, way);
  way->resize(3, x_.cols());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    members_[k]->extrapolate(h, &part_way_);
    way->middleCols(joint_->firstNode(k), part_way_.cols()) = part_way_;
  }
}

bool StepGroup::carries() const {
  return std::any_of(members_.begin(), members_.end(), [](const BodyMotion* member) {
    return member->body().surroundings.carries();
  });
}

void StepGroup::moveSurroundings(double s) {
  for (BodyMotion* member : members_) member->body().surroundings.moveTo(s);
}

void StepGroup::carryTo(double s, Points* all) const {
  if (!joint_) return members_.front()->body().surroundings.carryTo(s, all);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const BodySurroundings& surroundings = members_[k]->body().surroundings;
    if (!surroundings.carries()) continue;
    part_way_ = part(k, *all);
    surroundings.carryTo(s, &part_way_);
    all->middleCols(joint_->firstNode(k), part_way_.cols()) = part_way_;
  }
}

void StepGroup::carryHere(double s) {
  if (joint_) carryTo(s, &x_);
  for (BodyMotion* member : members_) {
    FemBody& body = member->body();
    if (!body.surroundings.carries()) continue;
    body.surroundings.carryTo(s, &body.x);
    body.elastic_energy.reset();
  }
}

double StepGroup::valueHere() {
  double sum = 0.0;
  for (BodyMotion* member : members_) sum += member->valueHere();
  for (const std::unique_ptr<MappedInteraction>& mapped : interactions_)
    sum += mapped->of_all->value(x_);
  return sum;
}

bool StepGroup::heldWay(double s, Points* way) const {
  if (!joint_) return members_.front()->body().heldWay(s, way);
  bool any = false;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    FemBody& body = members_[k]->body();
    if (!body.drive.held && !body.surroundings.carries()) continue;
    body.x = part(k, x_);
    if (!body.heldWay(s, &part_way_)) continue;
    if (!any) way->setZero(3, x_.cols());
    way->middleCols(joint_->firstNode(k), part_way_.cols()) = part_way_;
    any = true;
  }
  return any;
}

double StepGroup::unbalancedForce(const Points& gradient) {
  double sum = 0.0;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    sum += members_[k]->squaredUnbalancedForce(part(k, gradient));
  }
  return std::sqrt(sum);
}

void StepGroup::moveTools(double s) {
  for (BodyMotion* member : members_) member->body().tool_contact.moveTo(s);
}

void StepGroup::beginTouches() {
  forHooks([](StepHooks& hooks, const Points& x) { hooks.beginStep(x); });
}

double StepGroup::nextStage(double s, double end) const {
  double next = end;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    FemBody& body = members_[k]->body();
    next = std::min(next, body.tool_path.next(joint_ ? part(k, x_) : body.x, s, end));
  }
  return next;
}

bool StepGroup::pushTo(double s, const Points& all, Points* push) const {
  if (!joint_) return members_.front()->body().tool_path.pushTo(s, all, push);
  push->setZero(3, all.cols());
  bool any = false;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (!members_[k]->body().tool_path.pushTo(s, part(k, all), &part_way_)) continue;
    push->middleCols(joint_->firstNode(k), part_way_.cols()) = part_way_;
    any = true;
  }
  return any;
}

void StepGroup::invalidateInsideTools() {
  for (BodyMotion* member : members_) member->body().tool_contact.inside_tools.invalidate();
}

bool StepGroup::hasFriction() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const BodyMotion* member) { return member->body().contact.hasFriction(); });
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
  for (std::size_t k = 0; k < members_.size(); ++k) {
    FemBody& body = members_[k]->body();
    body.tool_path.search(joint_ ? part(k, x_) : body.x);
  }
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
  gradient_.setZero(3, x_.cols());
  for (const std::unique_ptr<MappedInteraction>& mapped : interactions_) {
    mapped->of_all->addGradient(x_, &gradient_);
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const Points& nodal = part(k, gradient_);
    interaction_forces_[k] = {-nodal.rowwise().sum(), nodal.norm()};
  }
}

}  // namespace palpate::tissue
