// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>

#include "palpate/base/types.h"
#include "support/accuracy_record.h"

namespace palpate::test {

/// The largest difference between a law's stresses and closed forms, over the deformations of one
/// test; recorded when the test ends.
class ClosedFormRecord {
 public:
  /// Both sides are formulas without iteration: 1e-16 for each operation, of which there are
  /// hundreds, and ten times that where terms cancel.
  static constexpr double kRounding = 1e-12;

  ClosedFormRecord(const std::string& law, const std::string& deformation)
      : row_{"Homogeneous deformations of every law",
             "a point",
             "",
             law + ", " + deformation,
             0.0,
             0.0,
             "closed form, derived by hand from the energy",
             -1.0,
             kRounding} {}
  ~ClosedFormRecord() { recordAccuracy(row_); }
  ClosedFormRecord(const ClosedFormRecord&) = delete;
  ClosedFormRecord& operator=(const ClosedFormRecord&) = delete;

  /// Stresses or one of them [Pa]; relative to their norm.
  void compare(const Eigen::Ref<const Eigen::MatrixXd>& found,
               const Eigen::Ref<const Eigen::MatrixXd>& expected) {
    const double error = (found - expected).norm() / expected.norm();
    if (!std::isfinite(row_.error) || error <= row_.error) return;  // NaN stays, and fails
    row_.value = found.norm();
    row_.reference = expected.norm();
    row_.error = error;
  }
  void compare(double found, double expected) {
    compare(Eigen::MatrixXd::Constant(1, 1, found), Eigen::MatrixXd::Constant(1, 1, expected));
  }

 private:
  AccuracyRow row_;
};

}  // namespace palpate::test
