// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/integrator.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/base/error.h"

namespace palpate::solver {
namespace {

// Residual over elastic forces up to which these count as forces of a motion [-].
constexpr double kBalanced = 0.1;

}  // namespace

std::vector<std::string> integratorNames() { return {"backward_euler", "bdf2", "static"}; }

Integrator::Integrator(const std::string& name, Eigen::VectorXd masses,
                       const RayleighDamping& damping)
    : two_step_(name == "bdf2"),
      massless_(name == "static"),
      masses_(std::move(masses)),
      damping_(damping),
      damping_load_(Points::Zero(3, masses_.size())),
      g_(Points::Zero(3, masses_.size())) {
  const std::vector<std::string> known = integratorNames();
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw std::invalid_argument("integrator = " + name + ": must be one of " + joinNames(known));
  }
}

void Integrator::start(const Points& x, const Points& v) {
  x_ = x;
  v_ = v;
  h_old_ = 0.0;
  balanced_ = true;
}

void Integrator::setElasticGradient(const Points& g, double unbalanced) {
  g_ = g;
  balanced_ = unbalanced <= kBalanced * g.norm();
}

void Integrator::addTerms(Potential* potential) const {
  potential->terms.push_back(&inertia_);
  if (needsElasticGradient()) potential->terms.push_back(&damping_load_);
}

void Integrator::beginStep(double h, Potential* potential) {
  h_ = h;
  if (two_step_ && h_old_ == h && balanced_old_) {
    k_ = 2.0 / 3.0 * h;
    x_hat_ = (4.0 * x_ - x_old_) / 3.0;
    v_hat_ = (4.0 * v_ - v_old_) / 3.0;
    if (needsElasticGradient()) g_hat_ = (4.0 * g_ - g_old_) / 3.0;
  } else {
    k_ = h;
    x_hat_ = x_;
    v_hat_ = v_;
    g_hat_ = g_;
  }
  if (massless_) {
    inertia_.beginStep(x_hat_, 0.0, masses_);
  } else {
    y_ = x_hat_ + k_ / (1.0 + damping_.mass * k_) * v_hat_;
    inertia_.beginStep(y_, (1.0 / k_ + damping_.mass) / k_, masses_);
  }
  const double stiffness = balanced_ ? damping_.stiffness : 0.0;
  potential->elastic_scale = 1.0 + stiffness / k_;
  if (needsElasticGradient()) damping_load_.setForces(stiffness / k_ * g_hat_);
}

void Integrator::endStep(const Points& x, const Points& g, double unbalanced) {
  x_old_.swap(x_);
  v_old_.swap(v_);
  if (needsElasticGradient()) {
    g_old_.swap(g_);
    balanced_old_ = balanced_;
    setElasticGradient(g, unbalanced);
  }
  h_old_ = h_;
  x_ = x;
  v_ = (x - x_hat_) / k_;
}

void Integrator::extrapolate(double h, Points* way) const {
  *way = h * v_;
  if (h_old_ > 0.0) *way += h * (h / h_old_) * (v_ - v_old_);
}

void Integrator::stop() {
  v_.setZero();
  h_old_ = 0.0;
}

void Integrator::goOnFrom(const Integrator& old, const Eigen::Matrix3Xd& free,
                          const std::function<Points(const Points&)>& carry,
                          const std::function<Points(const Points&)>& elastic_gradient) {
  h_old_ = old.h_old_;
  if (h_old_ == 0.0) return;
  // Transfers the difference of past and present, so that interpolation errors of both cancel and
  // cause no acceleration.
  x_old_ = x_ + carry(old.x_old_ - old.x_);
  v_old_ = v_ + carry(old.v_old_ - old.v_).cwiseProduct(free);
  if (!needsElasticGradient()) return;
  // Nodal forces are not a field; interpolation would change their sum, so they are recomputed.
  g_old_ = elastic_gradient(x_old_);
  if (!g_old_.allFinite()) g_old_ = g_;
  balanced_ = old.balanced_;
  balanced_old_ = old.balanced_old_;
}

void Integrator::save(StateWriter* out) const {
  // Forces that later steps do not use are omitted.
  const Points none;
  const Points& g = balanced_ ? g_ : none;
  const Points& g_old = balanced_old_ ? g_old_ : none;
  for (const Points* p : {&x_, &v_, &g, &x_old_, &v_old_, &g_old}) out->put(*p);
  out->put(h_old_);
}

void Integrator::restore(StateReader* in) {
  for (Points* p : {&x_, &v_, &g_, &x_old_, &v_old_, &g_old_}) {
    in->get(p);
    const bool needed = p == &x_ || p == &v_;
    if (p->cols() != masses_.size() && (needed || p->cols() != 0)) StateReader::fail();
  }
  in->get(&h_old_);
  balanced_ = g_.cols() > 0;
  if (!balanced_) g_.setZero(3, masses_.size());
  balanced_old_ = g_old_.cols() > 0 || !needsElasticGradient();
  if (h_old_ > 0.0 && (x_old_.cols() == 0 || v_old_.cols() == 0)) StateReader::fail();
}

}  // namespace palpate::solver
