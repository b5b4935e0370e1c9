// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coarse_groups.h"
#include "kernels/pcg_kernels.h"
#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// P^T A P, symmetric, six rows a group: its translations, and its rotations around its middle by
/// which what is its radius away moves by one. `moving`, 3 x n: 0 at components that P does not
/// move. Of a metric that is not diagonal A has what PressureMetric::weights() say.
Eigen::MatrixXd coarseMatrix(const fem::Stiffness& A, const CoarseGroups& groups,
                             const Points& points, const Points& moving, const PcgKernels& kernels);

}  // namespace palpate::solver
