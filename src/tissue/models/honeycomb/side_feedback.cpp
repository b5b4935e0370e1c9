// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_feedback.h"

namespace palpate::tissue {
namespace {

struct Outer {
  int cell;
  double sign;  // of the outward normal along the axis
};

Outer outer(const CellBalance& balance, int side) {
  const auto& cells = balance.lattice().sides[static_cast<std::size_t>(side)].cells;
  return cells[0] >= 0 ? Outer{cells[0], 1.0} : Outer{cells[1], -1.0};
}

}  // namespace

double sideReaction(const CellBalance& balance, const CellState& state, int side) {
  return outer(balance, side).sign * balance.force(state, side);
}

double printedSideReaction(const CellBalance& balance, const CellState& state, int side) {
  const Outer at = outer(balance, side);
  const int axis = balance.lattice().sides[static_cast<std::size_t>(side)].axis;
  const double longer = balance.edges(state, at.cell)[axis] - balance.lattice().size[axis];
  const double stretch = balance.fabric().stretch[static_cast<std::size_t>(at.cell)][axis] * longer;
  return sideReaction(balance, state, side) + 2.0 * stretch -
         2.0 * at.sign * balance.weights()[side];
}

double noSlipFriction(const CellBalance& balance, const CellState& state, int side, int axis,
                      double displacement, double contact_part) {
  const CellLattice& lattice = balance.lattice();
  const Outer at = outer(balance, side);
  const int normal = lattice.sides[static_cast<std::size_t>(side)].axis;
  const auto& ends = lattice.cells[static_cast<std::size_t>(at.cell)].sides;
  const auto k = static_cast<std::size_t>(2 * axis);
  const double middle = 0.5 * (state.sides[ends[k]] + state.sides[ends[k + 1]]);
  // t = G V / l^2 by the stretch 2 G V / l^2 along the side's normal.
  const double t = 0.5 * balance.fabric().stretch[static_cast<std::size_t>(at.cell)][normal];
  return -0.5 * contact_part * (t + t) * (displacement - middle);
}

}  // namespace palpate::tissue
