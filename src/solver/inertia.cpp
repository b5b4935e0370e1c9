// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/inertia.h"

namespace palpate::solver {

void Inertia::beginStep(const Points& y, double s, const Eigen::VectorXd& m) {
  y_ = y;
  weights_ = s * m;
}

void Inertia::forces(const Points& x, Points* f) const {
  f->noalias() = (y_ - x) * weights_.asDiagonal();
}

double Inertia::value(const Points& x) const {
  return 0.5 * ((x - y_).colwise().squaredNorm().transpose().cwiseProduct(weights_)).sum();
}

double Inertia::addGradient(const Points& x, Points* g) const {
  *g += (x - y_) * weights_.asDiagonal();
  return value(x);
}

void Inertia::addHessian(const Points&, fem::Tangent, fem::Stiffness* K) const {
  for (int i = 0; i < static_cast<int>(weights_.size()); ++i) K->addToDiagonal(i, weights_[i]);
}

}  // namespace palpate::solver
