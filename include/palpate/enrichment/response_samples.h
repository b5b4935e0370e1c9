// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::enrichment {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Responses of a body to displacements of single surface points, scaled, one sample per column.
/// Learned is the matrix A, q x 3, of y = A(input) d: a value y has q rows, and is 0 for d = 0.
struct ResponseSamples {
  Eigen::Matrix<double, 6, Eigen::Dynamic> inputs;  ///< Position and displacement.
  Points displacements;                             ///< d.
  Eigen::MatrixXd values;                           ///< y.

  Eigen::Index size() const { return inputs.cols(); }
};

}  // namespace palpate::enrichment
