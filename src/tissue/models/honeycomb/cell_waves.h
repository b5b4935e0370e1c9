// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "cell_balance.h"

namespace palpate::tissue {

/// Prescribed sides and rotations of a wave, and loads on the others.
struct CellControl {
  std::vector<bool> sides;                 ///< Whether each side is held or prescribed.
  std::vector<bool> turns;                 ///< Whether each rotation is held or prescribed.
  Eigen::VectorXd side_loads, turn_loads;  ///< [N], [N m]

  void reset(const CellBalance& balance);
};

/// Solves cells front by front, from those with a prescribed side [Wang 2005, 3.5, after Brown], or
/// without any from held ones.
///
/// Outward: sides moved by an earlier front are active for the next cells; a cell with active sides
/// only solves for those that are not controlled. There and back: all sides that are not controlled
/// are passive, and a second wave runs in reverse. Both converge to the same equilibrium.
class CellWaves {
 public:
  /// `cut_off` [m]; 0: none. @pre `balance` outlives this.
  CellWaves(const CellBalance& balance, bool outward_only, double cut_off);

  /// Begins a solve: no cell is reached, or with `whole` all are.
  void begin(bool whole);
  /// Computes the fronts.
  /// @pre Called before the first wave, and after changes of the control.
  void findFronts(const CellControl& control);
  /// Runs a wave and, unless outward only, its reverse. Returns the number of cell solves. `moved`:
  /// prescribed displacement of each side since the last wave [m].
  int run(const CellControl& control, const Eigen::VectorXd& moved, CellState* state);
  /// Whether a cell was solved since begin(): the accumulated displacement of the cell's sides
  /// reached the cut-off.
  bool reached(int cell) const { return reached_[static_cast<std::size_t>(cell)]; }

  /// Accumulated side displacements of skipped cells, the state between solves [m].
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
