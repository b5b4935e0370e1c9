// SPDX-License-Identifier: GPL-3.0-or-later
#include "compliant_contact.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

constexpr double kSufficientDecrease = 1e-4;
constexpr int kMaxHalvings = 30;
constexpr double kRoundoff = 1e-12;  // of the energy

}  // namespace

CompliantContact::CompliantContact(FemBody* body, const SurfaceCompliance* compliance)
    : body_(*body),
      compliance_(*compliance),
      local_(static_cast<std::size_t>(body->x.cols()), -1),
      step_(Points::Zero(3, body->x.cols())) {}

// The candidates' nodes, their compliance, and where the forces bring them.
void CompliantContact::gatherNodes(const Points& u0, Points* f, Points* x) {
  for (int node : nodes_) {
    local_[node] = -1;
    step_.col(node).setZero();
  }
  body_.contact.candidateNodes(&nodes_);
  const auto held = [this](int node) { return compliance_.find(node) < 0; };
  nodes_.erase(std::remove_if(nodes_.begin(), nodes_.end(), held), nodes_.end());
  const auto size = static_cast<Eigen::Index>(nodes_.size());
  C_.resize(3 * size, 3 * size);
  for (Eigen::VectorXd* vector : {&f_, &u0_, &free_}) vector->resize(3 * size);
  for (Eigen::Index a = 0; a < size; ++a) {
    local_[nodes_[a]] = static_cast<int>(a);
    f_.segment<3>(3 * a) = f->col(nodes_[a]);
    u0_.segment<3>(3 * a) = u0.col(nodes_[a]);
    free_.segment<3>(3 * a) = body_.free.col(nodes_[a]);
    const int row = compliance_.find(nodes_[a]);
    for (Eigen::Index b = 0; b < size; ++b) {
      C_.block<3, 3>(3 * a, 3 * b) = compliance_.block(row, compliance_.find(nodes_[b]));
    }
  }
  f->setZero();
  u_ = u0_;
  u_.noalias() += C_ * f_;
  *x = body_.mesh.points + u0;
  scatter(u_, x);
}

void CompliantContact::scatter(const Eigen::VectorXd& u, Points* x) const {
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    const auto row = 3 * static_cast<Eigen::Index>(a);
    x->col(nodes_[a]) = body_.mesh.points.col(nodes_[a]) + u.segment<3>(row);
  }
}

double CompliantContact::energy(const Eigen::VectorXd& f, const Eigen::VectorXd& u,
                                const Points& x) const {
  return 0.5 * f.dot(u - u0_) + body_.contact.value(x);
}

// The residual r = f - contact forces at x, and the contacts' stiffness H on the touched nodes.
void CompliantContact::linearise(const Points& x, bool exact) {
  body_.contact.collect(x, &contacts_);
  r_ = f_;
  touched_.clear();
  touched_at_.assign(nodes_.size(), -1);
  for (const contact::Contact& c : contacts_) {
    const contact::Touch& s = c.touch;
    for (int k = 0; k < 3; ++k) {
      const int a = s.weights[k] != 0.0 ? local_[s.nodes[k]] : -1;
      if (a < 0) continue;
      r_.segment<3>(3 * a) += s.weights[k] * c.force_W;
      if (touched_at_[a] >= 0) continue;
      touched_at_[a] = static_cast<int>(touched_.size());
      touched_.push_back(a);
    }
  }
  r_.array() *= free_.array();
  const auto size = 3 * static_cast<Eigen::Index>(touched_.size());
  H_.setZero(size, size);
  for (const contact::Contact& c : contacts_) {
    const contact::Touch& s = c.touch;
    Mat3 stiffness = body_.contact.stiffness(c);
    if (!exact) stiffness = body_.contact.convexStiffness(c, stiffness);
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) {
        const double weight = s.weights[k] * s.weights[l];
        if (weight == 0.0 || local_[s.nodes[k]] < 0 || local_[s.nodes[l]] < 0) continue;
        const int a = touched_at_[local_[s.nodes[k]]], b = touched_at_[local_[s.nodes[l]]];
        H_.block<3, 3>(3 * a, 3 * b) += weight * stiffness;
      }
    }
  }
}

// du and df = C^-1 du of a Newton step; false if it does not go downhill.
bool CompliantContact::direction() {
  const auto size = 3 * static_cast<Eigen::Index>(touched_.size());
  du_.noalias() = C_ * -r_;
  Eigen::VectorXd right(size);
  Eigen::MatrixXd C(size, size);
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    const Eigen::Index a = 3 * touched_[i], row = 3 * static_cast<Eigen::Index>(i);
    right.segment<3>(row) = du_.segment<3>(a);
    for (std::size_t j = 0; j < touched_.size(); ++j) {
      C.block<3, 3>(row, 3 * static_cast<Eigen::Index>(j)) = C_.block<3, 3>(a, 3 * touched_[j]);
    }
  }
  system_.setIdentity(size, size);
  system_.noalias() += C * H_;
  const Eigen::VectorXd force = -H_ * system_.partialPivLu().solve(right);
  df_ = -r_;
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    df_.segment<3>(3 * touched_[i]) += force.segment<3>(3 * static_cast<Eigen::Index>(i));
  }
  df_.array() *= free_.array();
  du_.noalias() = C_ * df_;
  return du_.allFinite() && du_.dot(r_) < 0.0;
}

bool CompliantContact::lineSearch(Points* x) {
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    step_.col(nodes_[a]) = du_.segment<3>(3 * static_cast<Eigen::Index>(a));
  }
  const double value = energy(f_, u_, *x), slope = du_.dot(r_);
  trial_x_ = *x;
  double alpha = body_.contact.maxStep(*x, step_);
  for (int k = 0; k <= kMaxHalvings; ++k, alpha *= 0.5) {
    trial_f_ = f_ + alpha * df_;
    trial_u_ = u_ + alpha * du_;
    scatter(trial_u_, &trial_x_);
    const double next = energy(trial_f_, trial_u_, trial_x_);
    if (next <= value + kSufficientDecrease * alpha * slope ||
        std::abs(alpha * slope) <= kRoundoff * std::abs(value)) {
      f_.swap(trial_f_);
      u_.swap(trial_u_);
      x->swap(trial_x_);
      return true;
    }
  }
  return false;
}

solver::NewtonReport CompliantContact::solve(const Points& u0, double tolerance, int max_iterations,
                                             Points* f, Points* x) {
  solver::NewtonReport report;
  gatherNodes(u0, f, x);
  if (nodes_.empty()) return report;
  for (;; ++report.iterations) {
    linearise(*x, true);
    report.residual = r_.norm();
    if (!std::isfinite(report.residual)) report.status = solver::SolveStatus::kNonFinite;
    if (report.residual <= tolerance || !std::isfinite(report.residual)) break;
    if (report.iterations == max_iterations) {
      report.status = solver::SolveStatus::kIterationLimit;
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
    f->col(nodes_[a]) = f_.segment<3>(3 * static_cast<Eigen::Index>(a));
  }
  return report;
}

}  // namespace palpate::tissue
