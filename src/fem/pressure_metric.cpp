// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/pressure_metric.h"

#include <stdexcept>

namespace palpate::fem {

PressureMetric PressureMetric::diagonal(Eigen::VectorXd weights) {
  PressureMetric metric;
  metric.weights_ = std::move(weights);
  return metric;
}

PressureMetric PressureMetric::inverseOf(const Eigen::SparseMatrix<double>& compliance) {
  PressureMetric metric;
  metric.compliance_ = compliance;
  metric.compliance_.makeCompressed();
  metric.weights_ = metric.compliance_.diagonal().cwiseInverse();
  auto factor = std::make_shared<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>>();
  factor->compute(metric.compliance_);
  if (factor->info() != Eigen::Success) {
    throw std::invalid_argument("the pressures' compliance is not positive definite");
  }
  metric.factor_ = factor;
  return metric;
}

void PressureMetric::apply(const Eigen::VectorXd& c, Eigen::VectorXd* p) const {
  if (isDiagonal()) {
    *p = weights_.cwiseProduct(c);
  } else {
    *p = factor_->solve(c);
  }
}

}  // namespace palpate::fem
