// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "palpate/springs/constraint_family.h"
#include "palpate/springs/least_squares.h"

namespace palpate::springs {

/// Linear conditions sum of factor times unknown = right, in weighted families.
class Conditions {
 public:
  explicit Conditions(Eigen::Index unknowns) : unknowns_(unknowns) {}

  /// Adds a family with this weight in the least squares. @returns its index.
  std::size_t addFamily(std::string name, double weight = 1.0);

  /// Begins a condition relative to `scale`.
  void begin(std::size_t family, double scale, double right = 0.0);
  /// Adds a term to the last condition.
  void add(Eigen::Index unknown, double factor) {
    entries_.emplace_back(rows() - 1, unknown, factor / scales_.back());
  }

  SparseMatrix matrix()
      const;  ///< Conditions over their scales, times the square roots of the weights.
  Eigen::VectorXd right() const;
  /// Factor on x with which the sum of a family's conditions equals that of their right-hand sides.
  double matchingFactor(std::size_t family, const Eigen::VectorXd& x) const;
  std::vector<ConstraintFamily> residuals(const Eigen::VectorXd& x) const;

 private:
  Eigen::Index rows() const { return static_cast<Eigen::Index>(right_.size()); }

  Eigen::Index unknowns_;
  std::vector<std::string> names_;
  std::vector<double> weights_;  // of families
  std::vector<std::size_t> family_;
  std::vector<double> scales_, right_;  // of conditions; right-hand sides are over the scale
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace palpate::springs
