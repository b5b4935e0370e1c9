// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_update.h"

#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

constexpr int kMaxIterations = 30;
constexpr int kWholeSteps = 8;  // iterations without a check of overshoot
constexpr int kMaxLinearIterations = 30;
constexpr double kLinearTolerance = 0.03;
constexpr int kMaxHalvings = 10;
constexpr double kSufficientDecrease = 1e-4;
// Largest curvature in the system, over c [-].
constexpr double kCurvature = 0.5;

}  // namespace

ContactUpdate::ContactUpdate(FemBody* body)
    : body_(*body), touched_(static_cast<std::size_t>(body->x.cols()), 0) {
  for (Points* p : {&gradient_, &free_x_, &right_, &step_, &r_, &p_, &Ap_, &inverse_diagonal_}) {
    p->setZero(3, body->x.cols());
  }
  curvature_.setZero(body->x.cols());
}

void ContactUpdate::clear() {
  for (int i : nodes_) {
    gradient_.col(i).setZero();
    touched_[i] = 0;
  }
  nodes_.clear();
  residual_ = deepest_ = 0.0;
  iterations_ = 0;
}

void ContactUpdate::touch(int node, const Points& x) {
  if (touched_[node]) return;
  touched_[node] = 1;
  nodes_.push_back(node);
  free_x_.col(node) = x.col(node);
}

// Warm start: moves the nodes of the last call by its forces.
void ContactUpdate::warmStart(const Eigen::VectorXd& coefficients, Points* x) {
  last_nodes_.clear();
  for (int i : nodes_) {
    if (gradient_.col(i).isZero(0.0)) continue;
    last_nodes_.push_back(i);
    step_.col(i) = (-1.0 / coefficients[i] * gradient_.col(i)).cwiseProduct(body_.free.col(i));
  }
  clear();
  for (int i : last_nodes_) {
    touch(i, *x);
    x->col(i) += step_.col(i);
  }
}

void ContactUpdate::apply(const Eigen::VectorXd& coefficients, double tolerance, Points* x) {
  warmStart(coefficients, x);
  collect(*x);
  iterations_ = 0;
  for (int& k = iterations_; !nodes_.empty(); ++k) {
    residual_ = unbalanced(coefficients, *x);
    if (!(residual_ > tolerance) || k == kMaxIterations) return;
    if (k >= kWholeSteps && solver::isInterrupted(body_.interrupt)) return;
    linearise(coefficients);
    solve(coefficients);
    go(coefficients, x);
    if (k >= kWholeSteps && !body_.contact.hasFriction()) turnBack(coefficients, x);
    collect(*x);
  }
}

// Takes the step, or a fraction of it where friction makes the energy grow.
void ContactUpdate::go(const Eigen::VectorXd& coefficients, Points* x) {
  if (!body_.contact.hasFriction()) {
    for (int i : nodes_) x->col(i) += step_.col(i);
    return;
  }
  const double here = energy(coefficients, *x);
  double slope = 0.0, gone = 0.0;
  for (int i : nodes_) slope -= step_.col(i).dot(right_.col(i));
  double part = 1.0;
  for (int k = 0; k <= kMaxHalvings; ++k, part *= 0.5) {
    for (int i : nodes_) x->col(i) += (part - gone) * step_.col(i);
    gone = part;
    if (energy(coefficients, *x) <= here + kSufficientDecrease * part * slope) return;
  }
}

// After an overshoot, a secant step to zero force along the direction: triangles that tilt under a
// tool are stiffer than their tangent.
void ContactUpdate::turnBack(const Eigen::VectorXd& coefficients, Points* x) {
  const std::size_t gone = nodes_.size();  // collect() may add nodes
  const auto along = [&] {
    double sum = 0.0;
    for (std::size_t n = 0; n < gone; ++n) sum += step_.col(nodes_[n]).dot(right_.col(nodes_[n]));
    return sum;
  };
  const double begin = along();
  collect(*x);
  unbalanced(coefficients, *x);
  const double end = along();
  if (!(end < 0.0 && begin > 0.0)) return;
  const double part = begin / (begin - end);
  for (std::size_t n = 0; n < gone; ++n) x->col(nodes_[n]) += (part - 1.0) * step_.col(nodes_[n]);
}

// Energy that apply() minimises [J].
double ContactUpdate::energy(const Eigen::VectorXd& coefficients, const Points& x) const {
  double sum = body_.contact.value(x);
  for (int i : nodes_) {
    sum += 0.5 * coefficients[i] *
           (x.col(i) - free_x_.col(i)).cwiseProduct(body_.free.col(i)).squaredNorm();
  }
  return sum;
}

bool ContactUpdate::limit(const Eigen::VectorXd& coefficients, const Points& begin, double longest,
                          Points* x) {
  bool all = true;
  for (int i : nodes_) {
    const Vec3 way = x->col(i) - begin.col(i);
    const double length = way.norm();
    if (length <= longest) continue;
    all = false;
    x->col(i) = begin.col(i) + longest / length * way;
    // Force of the limited displacement.
    gradient_.col(i) = coefficients[i] * (free_x_.col(i) - x->col(i));
  }
  return all;
}

// Collects the contacts at x with their forces, and adds their nodes to nodes_.
void ContactUpdate::collect(const Points& x) {
  body_.contact.collect(x, &contacts_);
  for (int i : nodes_) gradient_.col(i).setZero();
  deepest_ = 0.0;
  for (const contact::Contact& c : contacts_) {
    deepest_ = std::max(deepest_, c.touch.penetration());
    const contact::Touch& s = c.touch;
    for (int k = 0; k < 3; ++k) {
      if (s.weights[k] == 0.0) continue;
      const int i = s.nodes[k];
      touch(i, x);
      gradient_.col(i) += s.weights[k] * c.force_W;
    }
  }
}

double ContactUpdate::unbalanced(const Eigen::VectorXd& coefficients, const Points& x) {
  double square = 0.0;
  for (int i : nodes_) {
    right_.col(i) = (coefficients[i] * (free_x_.col(i) - x.col(i)) - gradient_.col(i))
                        .cwiseProduct(body_.free.col(i));
    square += right_.col(i).squaredNorm();
  }
  return std::sqrt(square);
}

// Computes the semidefinite part of the contact stiffness, or all of it where A stays positive
// definite.
void ContactUpdate::linearise(const Eigen::VectorXd& coefficients) {
  stiffness_.clear();
  for (int i : nodes_) curvature_[i] = 0.0;
  exact_.clear();
  for (const contact::Contact& c : contacts_) {
    const contact::Touch& s = c.touch;
    exact_.push_back(body_.contact.stiffness(c));
    stiffness_.push_back(body_.contact.convexStiffness(c, exact_.back()));
    const double curvature = (stiffness_.back() - exact_.back()).trace();
    for (int k = 0; k < 3; ++k) curvature_[s.nodes[k]] += s.weights[k] * curvature;
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const contact::Touch& s = contacts_[c].touch;
    bool small = true;
    for (int k = 0; k < 3; ++k) {
      const int i = s.nodes[k];
      small = small && (s.weights[k] == 0.0 || curvature_[i] <= kCurvature * coefficients[i]);
    }
    if (small) stiffness_[c] = exact_[c];
  }
}

// A d with A = diag(c) + the contacts' stiffness.
void ContactUpdate::multiply(const Eigen::VectorXd& coefficients, const Points& d,
                             Points* Ad) const {
  for (int i : nodes_) Ad->col(i) = coefficients[i] * d.col(i);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const contact::Touch& s = contacts_[c].touch;
    const Vec3 force = stiffness_[c] * s.of(d);
    for (int k = 0; k < 3; ++k) {
      if (s.weights[k] != 0.0) Ad->col(s.nodes[k]) += s.weights[k] * force;
    }
  }
  for (int i : nodes_) Ad->col(i).array() *= body_.free.col(i).array();
}

// Solves A step = right by conjugate gradients.
void ContactUpdate::solve(const Eigen::VectorXd& coefficients) {
  for (int i : nodes_) inverse_diagonal_.col(i).setConstant(coefficients[i]);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const contact::Touch& s = contacts_[c].touch;
    for (int k = 0; k < 3; ++k) {
      const Vec3 diagonal = stiffness_[c].diagonal().cwiseMax(0.0);
      inverse_diagonal_.col(s.nodes[k]) += s.weights[k] * s.weights[k] * diagonal;
    }
  }
  double rz = 0.0;
  for (int i : nodes_) {
    inverse_diagonal_.col(i) = inverse_diagonal_.col(i).cwiseInverse();
    step_.col(i).setZero();
    r_.col(i) = right_.col(i);
    p_.col(i) = inverse_diagonal_.col(i).cwiseProduct(r_.col(i));
    rz += r_.col(i).dot(p_.col(i));
  }
  const double target = kLinearTolerance * kLinearTolerance * rz;
  for (int k = 0; k < kMaxLinearIterations && rz > target; ++k) {
    multiply(coefficients, p_, &Ap_);
    double curvature = 0.0, next = 0.0;
    for (int i : nodes_) curvature += p_.col(i).dot(Ap_.col(i));
    const double alpha = rz / curvature;
    for (int i : nodes_) {
      step_.col(i) += alpha * p_.col(i);
      r_.col(i) -= alpha * Ap_.col(i);
      next += r_.col(i).cwiseAbs2().dot(inverse_diagonal_.col(i));
    }
    for (int i : nodes_) {
      p_.col(i) = inverse_diagonal_.col(i).cwiseProduct(r_.col(i)) + next / rz * p_.col(i);
    }
    rz = next;
  }
}

}  // namespace palpate::tissue
