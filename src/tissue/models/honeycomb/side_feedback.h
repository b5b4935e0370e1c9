// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cell_balance.h"

namespace palpate::tissue {

/// Normal force of a cell's outer side on its support, outward [N]: [Wang 2005, eq. 3.20] with the
/// signs of (3.8),
///
///   N = P A - k (L - l) + sum_n t_n (d_n - d) + rho V g_i / 2,  d outward.
///
/// The sum over prescribed and held sides is the weight.
double sideReaction(const CellBalance& balance, const CellState& state, int side);

/// The same as (3.20) is printed, with opposite signs of stretch and weight; it differs by
/// 2 k (L - l) - rho V g_i.
double printedSideReaction(const CellBalance& balance, const CellState& state, int side);

/// Tangential force on a tool that sticks to a cell's outer side, at a point with `displacement`
/// [m] along the axis, in the state's frame [Wang 2005, eq. 3.21, 3.22]:
///
///   F = -(xi / 2) (t^+ + t^-) (displacement - (d^+ + d^-) / 2),
///
/// of the two walls normal to the axis, with the shear stiffness t to an imagined neighbour beyond
/// the side. d are displacements along the positive axis; their mean is the cell's. `contact_part`:
/// touched fraction xi of the side's area, in [0, 1].
double noSlipFriction(const CellBalance& balance, const CellState& state, int side, int axis,
                      double displacement, double contact_part);

}  // namespace palpate::tissue
