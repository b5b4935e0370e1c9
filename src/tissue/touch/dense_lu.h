// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace palpate::tissue {

/// x <- A^-1 x by Gauss's elimination with row pivoting, in the place of A, without memory of its
/// own. A singular A leaves numbers that are not finite.
void solveInPlace(Eigen::Map<Eigen::MatrixXd>& A, Eigen::Map<Eigen::VectorXd>& x);

}  // namespace palpate::tissue
