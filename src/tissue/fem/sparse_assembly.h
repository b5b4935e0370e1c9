// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>

#include "palpate/fem/stiffness.h"

namespace palpate::tissue {

/// K as one sparse matrix of the 3 n components, node after node, with the volumes of pressure
/// nodes multiplied out.
/// @throws std::invalid_argument where their metric is not diagonal (element p1p1).
Eigen::SparseMatrix<double> assembleSparse(const fem::Stiffness& K);

}  // namespace palpate::tissue
