// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coarse_groups.h"
#include "kernels/pcg_kernels.h"
#include "palpate/fem/stiffness.h"

namespace palpate::solver {

/// P^T A P, symmetric, six rows per group: translations, and rotations about its centre that move
/// points at its radius by one. `moving`, 3 x n: 0 for components that P does not move. A metric
/// that is not diagonal is replaced by PressureMetric::weights().
Eigen::MatrixXd coarseMatrix(const fem::Stiffness& A, const CoarseGroups& groups,
                             const Points& points, const Points& moving, const PcgKernels& kernels);

}  // namespace palpate::solver
