// SPDX-License-Identifier: GPL-3.0-or-later
#include "conditions.h"

#include <algorithm>
#include <cmath>

namespace palpate::springs {

std::size_t Conditions::addFamily(std::string name, double weight) {
  names_.push_back(std::move(name));
  weights_.push_back(weight);
  return names_.size() - 1;
}

void Conditions::begin(std::size_t family, double scale, double right) {
  family_.push_back(family);
  scales_.push_back(scale);
  right_.push_back(right / scale);
}

SparseMatrix Conditions::matrix() const {
  std::vector<Eigen::Triplet<double>> weighted;
  weighted.reserve(entries_.size());
  for (const auto& entry : entries_) {
    const double weight = weights_[family_[static_cast<std::size_t>(entry.row())]];
    weighted.emplace_back(entry.row(), entry.col(), std::sqrt(weight) * entry.value());
  }
  SparseMatrix matrix(rows(), unknowns_);
  matrix.setFromTriplets(weighted.begin(), weighted.end());
  return matrix;
}

Eigen::VectorXd Conditions::right() const {
  Eigen::VectorXd right(rows());
  for (std::size_t i = 0; i < right_.size(); ++i) {
    right[static_cast<Eigen::Index>(i)] = std::sqrt(weights_[family_[i]]) * right_[i];
  }
  return right;
}

double Conditions::matchingFactor(std::size_t family, const Eigen::VectorXd& x) const {
  double left = 0.0, right = 0.0;
  for (const auto& entry : entries_) {
    const auto row = static_cast<std::size_t>(entry.row());
    if (family_[row] == family) left += scales_[row] * entry.value() * x[entry.col()];
  }
  for (std::size_t i = 0; i < right_.size(); ++i) {
    if (family_[i] == family) right += scales_[i] * right_[i];
  }
  return right / left;
}

std::vector<ConstraintFamily> Conditions::residuals(const Eigen::VectorXd& x) const {
  std::vector<double> left(right_.size(), 0.0);
  for (const auto& entry : entries_) {
    left[static_cast<std::size_t>(entry.row())] += entry.value() * x[entry.col()];
  }
  std::vector<ConstraintFamily> families;
  for (std::size_t f = 0; f < names_.size(); ++f) {
    ConstraintFamily family{names_[f], 0.0, 0.0, 0.0};
    double count = 0.0;
    for (std::size_t i = 0; i < right_.size(); ++i) {
      if (family_[i] != f) continue;
      const double error = std::abs(left[i] - right_[i]);
      family.scale += scales_[i];
      family.rms += error * error;
      family.worst = std::max(family.worst, error);
      ++count;
    }
    if (count > 0.0) {
      family.scale /= count;
      family.rms = std::sqrt(family.rms / count);
    }
    families.push_back(family);
  }
  return families;
}

}  // namespace palpate::springs
