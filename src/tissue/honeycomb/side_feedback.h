// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cell_balance.h"

namespace palpate::tissue {

/// What an outer side of a cell presses outward with on what holds it in place, normal to it [N]:
/// [Wang 2005, eq. 3.20] with the signs of (3.8),
///
///   N = P A - k (L - l) + sum_n t_n (d_n - d) + rho V g_i / 2,  d outward.
///
/// Of all sides that are prescribed and held the sum is the weight: it is what is unbalanced there.
double sideReaction(const CellBalance& balance, const CellState& state, int side);

/// The same as (3.20) is printed: the stretch and the weight have the other sign, as if walls that
/// are stretched pushed. It differs by 2 k (L - l) - rho V g_i, and cancels with nothing.
double printedSideReaction(const CellBalance& balance, const CellState& state, int side);

/// The force along an axis on a tool that clings to an outer side of a cell, at a place that has
/// gone `displacement` [m] along that axis, world or O as the state is [Wang 2005, eq. 3.21, 3.22]:
///
///   F = -(xi / 2) (t^+ + t^-) (displacement - (d^+ + d^-) / 2),
///
/// of the two walls normal to the axis, which would go on as far beyond the side: t is what each of
/// them has for a neighbour there. d are displacements along the positive axis, so that their mean
/// is the cell's. `contact_part`: xi, of the side's area that is touched, in [0, 1].
double noSlipFriction(const CellBalance& balance, const CellState& state, int side, int axis,
                      double displacement, double contact_part);

}  // namespace palpate::tissue
