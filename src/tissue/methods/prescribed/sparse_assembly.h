// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>

#include "palpate/fem/stiffness.h"

namespace palpate::tissue {

/// Assembles K as a sparse matrix, 3 n x 3 n, node by node, with the volume terms of pressure
/// nodes.
/// @throws std::invalid_argument where the pressure metric is not diagonal (element p1p1).
Eigen::SparseMatrix<double> assembleSparse(const fem::Stiffness& K);

}  // namespace palpate::tissue
