// SPDX-License-Identifier: GPL-3.0-or-later
#include "compliant_contact.h"

#include <algorithm>
#include <cmath>

#include "dense_lu.h"

namespace palpate::tissue {
namespace {

constexpr double kSufficientDecrease = 1e-4;
constexpr int kMaxHalvings = 30;
constexpr double kRoundoff = 1e-12;  // relative to the energy [-]

}  // namespace

CompliantContact::CompliantContact(contact::ContactPotential* contact, const Points& X,
                                   const fem::FreeMask& free, const NodeCompliance& compliance)
    : contact_(*contact),
      X_(X),
      mask_(free),
      compliance_(compliance),
      local_(static_cast<std::size_t>(X.cols()), -1),
      step_(Points::Zero(3, X.cols())) {}

CompliantContact::Square CompliantContact::square(Eigen::Index size, std::vector<double>* memory) {
  const auto count = static_cast<std::size_t>(size * size);
  if (memory->size() < count) memory->resize(count);
  return {memory->data(), size, size};
}

// Collects the candidates' nodes and their positions under the forces.
void CompliantContact::gatherNodes(const Points& u0, Points* f, Points* x) {
  for (int node : nodes_) {
    local_[node] = -1;
    step_.col(node).setZero();
  }
  contact_.candidateNodes(&nodes_);
  const auto held = [this](int node) { return compliance_.index[node] < 0; };
  nodes_.erase(std::remove_if(nodes_.begin(), nodes_.end(), held), nodes_.end());
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  size_ = 3 * count;
  if (vectors_.rows() < size_) vectors_.resize(size_, kNumVectors);
  for (Eigen::Index a = 0; a < count; ++a) {
    local_[nodes_[a]] = static_cast<int>(a);
    of(kF).segment<3>(3 * a) = f->col(nodes_[a]);
    of(kU0).segment<3>(3 * a) = u0.col(nodes_[a]);
    of(kFree).segment<3>(3 * a) = mask_.col(nodes_[a]);
  }
  f->setZero();
  of(kU) = of(kU0);
  addMotion(kF, kU);
  *x = X_ + u0;
  scatter(kU, x);
}

// u += C f, with few nonzero forces.
void CompliantContact::addMotion(Vector f, Vector u) {
  for (std::size_t b = 0; b < nodes_.size(); ++b) {
    const Vec3 force = of(f).segment<3>(3 * static_cast<Eigen::Index>(b));
    if (force.isZero(0.0)) continue;
    for (std::size_t a = 0; a < nodes_.size(); ++a) {
      of(u).segment<3>(3 * static_cast<Eigen::Index>(a)) += compliance(a, b) * force;
    }
  }
}

void CompliantContact::scatter(Vector u, Points* x) const {
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    const auto row = 3 * static_cast<Eigen::Index>(a);
    x->col(nodes_[a]) = X_.col(nodes_[a]) + of(u).segment<3>(row);
  }
}

double CompliantContact::energy(Vector f, Vector u, const Points& x) const {
  return 0.5 * of(f).dot(of(u) - of(kU0)) + contact_.value(x);
}

// Computes the residual r = f - contact forces at x, and the contact stiffness H.
void CompliantContact::linearise(const Points& x, bool exact) {
  contact_.collect(x, &contacts_);
  of(kR) = of(kF);
  touched_.clear();
  touched_at_.assign(nodes_.size(), -1);
  for (const contact::Contact& c : contacts_) {
    const contact::Touch& s = c.touch;
    for (int k = 0; k < 3; ++k) {
      const int a = s.weights[k] != 0.0 ? local_[s.nodes[k]] : -1;
      if (a < 0) continue;
      of(kR).segment<3>(3 * a) += s.weights[k] * c.force_W;
      if (touched_at_[a] >= 0) continue;
      touched_at_[a] = static_cast<int>(touched_.size());
      touched_.push_back(a);
    }
  }
  of(kR).array() *= of(kFree).array();
  square(3 * static_cast<Eigen::Index>(touched_.size()), &H_memory_).setZero();
  for (const contact::Contact& c : contacts_) {
    const Mat3 stiffness = contact_.stiffness(c);
    addStiffness(c.touch, exact ? stiffness : contact_.convexStiffness(c, stiffness));
  }
}

void CompliantContact::addStiffness(const contact::Touch& touch, const Mat3& stiffness) {
  Square H = square(3 * static_cast<Eigen::Index>(touched_.size()), &H_memory_);
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {
      const double weight = touch.weights[k] * touch.weights[l];
      if (weight == 0.0 || local_[touch.nodes[k]] < 0 || local_[touch.nodes[l]] < 0) continue;
      const int a = touched_at_[local_[touch.nodes[k]]], b = touched_at_[local_[touch.nodes[l]]];
      H.block<3, 3>(3 * a, 3 * b) += weight * stiffness;
    }
  }
}

// Computes Newton steps of u and f = C^-1 u. Returns false without descent.
bool CompliantContact::direction() {
  const auto count = static_cast<Eigen::Index>(touched_.size());
  const Square H = square(3 * count, &H_memory_);
  of(kStepF) = -of(kR);
  of(kStepU).setZero();
  addMotion(kStepF, kStepU);
  // System (1 + C H) of the touched nodes; H is sparse.
  Square system = square(3 * count, &system_memory_);
  system.setIdentity();
  right_.resize(static_cast<std::size_t>(3 * count));
  Eigen::Map<Eigen::VectorXd> right(right_.data(), 3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    right.segment<3>(3 * i) = of(kStepU).segment<3>(3 * touched_[i]);
    for (Eigen::Index j = 0; j < count; ++j) {
      const Mat3 block = H.block<3, 3>(3 * i, 3 * j);
      if (block.isZero(0.0)) continue;
      for (Eigen::Index k = 0; k < count; ++k) {
        system.block<3, 3>(3 * k, 3 * j) += compliance(touched_[k], touched_[i]) * block;
      }
    }
  }
  solveInPlace(system, right);
  for (Eigen::Index i = 0; i < count; ++i) {
    of(kStepF).segment<3>(3 * touched_[i]) -= H.middleRows<3>(3 * i).lazyProduct(right);
  }
  of(kStepF).array() *= of(kFree).array();
  of(kStepU).setZero();
  addMotion(kStepF, kStepU);
  return of(kStepU).allFinite() && of(kStepU).dot(of(kR)) < 0.0;
}

bool CompliantContact::lineSearch(Points* x) {
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    step_.col(nodes_[a]) = of(kStepU).segment<3>(3 * static_cast<Eigen::Index>(a));
  }
  const double value = energy(kF, kU, *x), slope = of(kStepU).dot(of(kR));
  trial_x_ = *x;
  double alpha = contact_.maxStep(*x, step_);
  for (int k = 0; k <= kMaxHalvings; ++k, alpha *= 0.5) {
    of(kTrialF) = of(kF) + alpha * of(kStepF);
    of(kTrialU) = of(kU) + alpha * of(kStepU);
    scatter(kTrialU, &trial_x_);
    const double next = energy(kTrialF, kTrialU, trial_x_);
    if (next <= value + kSufficientDecrease * alpha * slope ||
        std::abs(alpha * slope) <= kRoundoff * std::abs(value)) {
      of(kF) = of(kTrialF);
      of(kU) = of(kTrialU);
      x->swap(trial_x_);
      return true;
    }
  }
  return false;
}

solver::NewtonReport CompliantContact::solve(const Points& u0, double tolerance, int max_iterations,
                                             Points* f, Points* x,
                                             const solver::Interrupt* interrupt) {
  solver::NewtonReport report;
  gatherNodes(u0, f, x);
  if (nodes_.empty()) return report;
  for (;; ++report.iterations) {
    linearise(*x, true);
    report.residual = of(kR).norm();
    if (!std::isfinite(report.residual)) report.status = solver::SolveStatus::kNonFinite;
    if (report.residual <= tolerance || !std::isfinite(report.residual)) break;
    if (report.iterations == max_iterations) {
      report.status = solver::SolveStatus::kIterationLimit;
      break;
    }
    if (report.iterations > 0 && solver::isInterrupted(interrupt)) {
      report.status = solver::SolveStatus::kDeadline;
      break;
    }
    if (!direction()) {
      linearise(*x, false);
      ++report.projections;
      if (!direction()) report.status = solver::SolveStatus::kNotPositiveDefinite;
    }
    if (!report.projections || report.status == solver::SolveStatus::kConverged) {
      if (!lineSearch(x)) report.status = solver::SolveStatus::kLineSearchFailed;
    }
    if (report.status != solver::SolveStatus::kConverged) break;
  }
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    f->col(nodes_[a]) = of(kF).segment<3>(3 * static_cast<Eigen::Index>(a));
  }
  return report;
}

}  // namespace palpate::tissue
