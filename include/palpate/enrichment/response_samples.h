// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::enrichment {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// What a body answers to displacements of single points of its surface, scaled, a sample a column:
/// values y = A(input) d of q rows are to be learned as the matrix A, q x 3, so that nothing
/// displaced answers nothing.
struct ResponseSamples {
  Eigen::Matrix<double, 6, Eigen::Dynamic> inputs;  ///< Where it is, and its displacement.
  Points displacements;                             ///< d.
  Eigen::MatrixXd values;                           ///< y.

  Eigen::Index size() const { return inputs.cols(); }
};

}  // namespace palpate::enrichment
