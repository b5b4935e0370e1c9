// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
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
/// are not controlled are passive, and a second wave runs in the opposite order. Where both
/// converge they come to the same state, that in which all balances.
class CellWaves {
 public:
  /// `cut_off` [m], 0: none. `balance` is kept by reference.
  CellWaves(const CellBalance& balance, bool outward_only, double cut_off);

  /// Before the first wave, and where what is controlled has become other: the fronts. No cell has
  /// been reached, but where it `goes_on`.
  void begin(const CellControl& control, bool goes_on = false);
  /// One wave; returns how many cells were solved. `moved`: how far each side was moved from
  /// outside since the last one [m].
  int run(const CellControl& control, const Eigen::VectorXd& moved, CellState* state);
  /// Whether the cell has taken part since begin(): a side of it had moved by the cut-off.
  bool reached(int cell) const { return reached_[static_cast<std::size_t>(cell)]; }

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
