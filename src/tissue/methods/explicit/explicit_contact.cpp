// SPDX-License-Identifier: GPL-3.0-or-later
#include "explicit_contact.h"

#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

constexpr double kMaxLeapSteps = 256.0;
// Largest displacement of a node by contact in a step, over the element size [-].
constexpr double kContactWay = 0.5;
// Most augmentations of friction in a step.
constexpr int kMaxExplicitAugmentations = 6;

}  // namespace

ExplicitContact::ExplicitContact(FemBody* body)
    : body_(*body),
      element_size_(std::cbrt(body->elasticity->volume() / static_cast<double>(body->x.cols()))),
      update_(body) {}

double ExplicitContact::steps() const {
  return std::min(std::ceil(body_.tool_path.leap(element_size_) / kToolWay), kMaxLeapSteps);
}

void ExplicitContact::begin() {
  update_.clear();
  limited_ = false;
  friction_converged_ = true;
  part_ = 0.0;
  body_.tool_path.moveTo(0.0);
}

// Whether the displacement `way`, 3 x n [m], may carry tissue half-way to the middle of a moved
// tool. Conservative.
bool ExplicitContact::mayJump(const Points& way) const {
  if (!body_.contact.hasCandidates()) return false;
  const double margin = (1.0 - kToolWay) * body_.tool_path.thinnest() - update_.deepest();
  return !(2.0 * std::sqrt(way.colwise().squaredNorm().maxCoeff()) < margin);
}

bool ExplicitContact::step(double s, const Eigen::VectorXd& coefficients, Points* next) {
  body_.tool_path.beginStep(body_.x);
  body_.tool_path.moveTo(s);
  tool_way_ = (s - part_) * body_.tool_path.longestWay();
  part_ = s;
  limited_ = false;
  friction_converged_ = true;
  if (mayJump(*next) && body_.contact.maxStep(body_.x, *next) < 1.0) return false;
  *next += body_.x;
  if (!body_.tool_path.candidatesHold(*next)) body_.tool_path.search(*next);
  if (!body_.contact.hasCandidates()) {
    update_.clear();
    iterations_ = 0;
    return true;
  }
  answer(coefficients, next);
  limited_ = !update_.limit(coefficients, body_.x, kContactWay * element_size_, next);
  return true;
}

// Solves contact, again after each augmentation while friction exceeds Coulomb's law. Otherwise the
// limit at the step's end would remove a force that has moved tissue.
void ExplicitContact::answer(const Eigen::VectorXd& coefficients, Points* next) {
  const bool rubs = body_.contact.hasFriction();
  const double tolerance = body_.tolerance();
  if (rubs) untouched_ = *next;
  update_.apply(coefficients, tolerance, next);
  iterations_ = update_.iterations();
  for (int k = 0; rubs && update_.residual() <= tolerance; ++k) {
    friction_converged_ = body_.contact.augmentationConverged(*next);
    if (friction_converged_ || k == kMaxExplicitAugmentations ||
        solver::isInterrupted(body_.interrupt))
      return;
    body_.contact.augment(*next);
    *next = untouched_;
    update_.apply(coefficients, tolerance, next);
    iterations_ = std::max(iterations_, update_.iterations());
  }
}

// A deadline during the last augmentation counts as late.
solver::SolveStatus ExplicitContact::status(double tolerance, bool late) const {
  if (late || (!friction_converged_ && solver::isInterrupted(body_.interrupt))) {
    return solver::SolveStatus::kDeadline;
  }
  if (limited_) return solver::SolveStatus::kLineSearchFailed;
  return friction_converged_ && residual() <= tolerance ? solver::SolveStatus::kConverged
                                                        : solver::SolveStatus::kIterationLimit;
}

}  // namespace palpate::tissue
