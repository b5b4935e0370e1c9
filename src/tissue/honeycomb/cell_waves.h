// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "cell_balance.h"

namespace palpate::tissue {

/// Sides and turns that a wave finds as they are to be, and what acts on the others.
struct CellControl {
  std::vector<bool> sides;                 ///< Of each: it is held, or moved from outside.
  std::vector<bool> turns;                 ///< Likewise.
  Eigen::VectorXd side_loads, turn_loads;  ///< [N], [N m]

  void reset(const CellBalance& balance);
};

/// Solves cell after cell, front by front, from those with a side that is moved from outside [Wang
/// 2005, 3.5, after Brown]; where there is none, from those that are held.
///
/// Outward: a side that an earlier front has moved is active, as prescribed, to the cells behind; a
/// cell of which all are solves for those that are not controlled. There and back: all sides that
/// are not controlled are passive, and a second wave runs in the opposite order.
/// Where both converge they come to the same state, that in which all balances.
class CellWaves {
 public:
  /// `cut_off` [m], 0: none. `balance` is kept by reference.
  CellWaves(const CellBalance& balance, bool outward_only, double cut_off);

  /// A solve begins: no cell has been reached, or, where none is to be left out, each `whole`.
  void begin(bool whole);
  /// Before the first wave, and where what is controlled has become other: the fronts.
  void findFronts(const CellControl& control);
  /// One wave; returns how many cells were solved. `moved`: how far each side was moved from
  /// outside since the last one [m].
  int run(const CellControl& control, const Eigen::VectorXd& moved, CellState* state);
  /// Whether the cell has taken part since begin(): its sides had moved by the cut-off, in all,
  /// since it last did.
  bool reached(int cell) const { return reached_[static_cast<std::size_t>(cell)]; }

  /// How far the sides of cells have moved that were left out: all memory between solves.
  void forget() { std::fill(pending_.begin(), pending_.end(), 0.0); }
  const std::vector<double>& memory() const { return pending_; }
  void remember(const std::vector<double>& pending) { pending_ = pending; }

 private:
  void solve(int cell, const CellControl& control, CellState* state);

  const CellBalance& balance_;
  bool outward_only_;
  double cut_off_;
  std::vector<int> order_, front_;
  std::vector<bool> reached_;
  std::vector<double> pending_;  // [m]
  int solved_ = 0;
};

}  // namespace palpate::tissue
