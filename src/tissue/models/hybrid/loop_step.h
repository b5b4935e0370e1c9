// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/fem/block_matrix.h"
#include "palpate/fem/supports.h"

namespace palpate::tissue {

/// The longest step [s] in which a loop between a region and a rest is stable: a mode of backward
/// Euler goes as r^2 (K + M/h^2 (1 + c h)) + r (S - M/h^2 (2 + c h)) + M/h^2 = 0, with K and M of
/// the region, S of the rest at the border and c the damping by mass [1/s], so that |r| < 1 as long
/// as K + M (4 + 2 c h)/h^2 - S is positive definite. The largest eigenvalue of M^-1 (S - K) comes
/// from Lanczos' iteration [Golub, Van Loan 1996, sec. 9.1]. Infinity: any step is.
///
/// `together`: K + S, `region`: K, of one pattern; `masses`: n [kg]; `moves`: 1 at components of
/// the region that are free, else 0.
double longestLoopStep(const fem::BlockMatrix& together, const fem::BlockMatrix& region,
                       const Eigen::VectorXd& masses, const fem::FreeMask& moves, double damping);

}  // namespace palpate::tissue
