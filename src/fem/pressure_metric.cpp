// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/pressure_metric.h"

#include <stdexcept>
#include <utility>

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

PressureMetric PressureMetric::sideBySide(const std::vector<const PressureMetric*>& parts) {
  bool all_diagonal = true;
  Eigen::Index size = 0;
  for (const PressureMetric* part : parts) {
    all_diagonal = all_diagonal && part->isDiagonal();
    size += part->size();
  }
  Eigen::VectorXd weights(size);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index first = 0;
  for (const PressureMetric* part : parts) {
    weights.segment(first, part->size()) = part->weights_;
    for (Eigen::Index p = 0; part->isDiagonal() && p < part->size(); ++p) {
      entries.emplace_back(first + p, first + p, 1.0 / part->weights_[p]);
    }
    for (Eigen::Index column = 0; column < part->compliance_.outerSize(); ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(part->compliance_, column); entry;
           ++entry) {
        entries.emplace_back(first + entry.row(), first + entry.col(), entry.value());
      }
    }
    first += part->size();
  }
  if (all_diagonal) return diagonal(std::move(weights));
  Eigen::SparseMatrix<double> compliance(size, size);
  compliance.setFromTriplets(entries.begin(), entries.end());
  return inverseOf(compliance);
}

void PressureMetric::apply(const Eigen::VectorXd& c, Eigen::VectorXd* p) const {
  if (isDiagonal()) {
    *p = weights_.cwiseProduct(c);
  } else {
    *p = factor_->solve(c);
  }
}

}  // namespace palpate::fem
