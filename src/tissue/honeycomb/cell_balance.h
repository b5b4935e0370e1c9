// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "cell_fabric.h"
#include "cell_lattice.h"

namespace palpate::tissue {

/// The unknowns of a lattice of cells.
struct CellState {
  Eigen::VectorXd sides;      ///< Displacement of each along the positive axis [m].
  Eigen::VectorXd pressures;  ///< Of the fluid in each cell, at its centre [Pa].
  Eigen::VectorXd turns;      ///< Of cell c about axis a: 3 c + a [rad].
};

/// What balances in a lattice of cells: forces on sides and the fluid's volume [Wang 2005, eq.
/// 3.2-3.11, signs as below], and torques on cells (3.12-3.19). With d the displacement of a side
/// along its axis i, L = l + d^+ - d^- the cell's edges, A_i = V / l_i or, exact, L_j L_m:
///
///   F = [P A - k (L - l)] of the cell before - the same of the cell behind
///       - sum_n t_n (d - d_n) - t_held d + rho V g_i / 2 of each cell + load
///   volume:  sum_i A_i (L_i - l_i) = 0,  exact:  L_1 L_2 L_3 - V = 0
///
/// The cell's own area makes the fluid's forces on it cancel; (3.5) has the mean of both cells'.
/// The half weights are what the fluid's pressure has above its centre's (3.6), with the slope that
/// the lattice had at rest.
class CellBalance {
 public:
  /// `weight`: of each cell in O, 3 x m [N]. All are kept by reference.
  CellBalance(const CellLattice& lattice, const CellFabric& fabric, const HeldSides& held,
              const Points& weight, bool exact);

  CellState rest() const;
  /// On a side along its axis, without contact [N].
  double force(const CellState& state, int side) const;
  /// On a cell about an axis, unknown 3 cell + axis, without contact [N m].
  double torque(const CellState& state, int turn) const;
  /// Of a cell: how much too large [m^3].
  double volumeError(const CellState& state, int cell) const;
  /// Edges of a cell [m], and what its pressure acts on, by axis [m^2].
  Vec3 edges(const CellState& state, int cell) const;
  Vec3 areas(const CellState& state, int cell) const;
  /// [J]
  double elasticEnergy(const CellState& state) const;
  /// Volume over that at rest of the cell that is worst, or its shortest edge over that at rest,
  /// whichever is less.
  double leastRatio(const CellState& state) const;

  /// Moves the sides of a cell that `passive` says, and its pressure, to where these balance and
  /// its volume is right, all else as it is: 7 - m unknowns for m active sides. Linear volumes: at
  /// once; exact: `steps` of Newton's method without the change of areas. Returns the largest
  /// change [m]; nothing is done without a passive side. `load`: on each side [N].
  double solveCell(int cell, const std::array<bool, 6>& passive, const Eigen::VectorXd& load,
                   int steps, CellState* state) const;
  /// Turns a cell about the axes that are not `controlled` to where its torques balance with
  /// `load`, both of each turn [N m].
  void solveTurns(int cell, const std::vector<bool>& controlled, const Eigen::VectorXd& load,
                  CellState* state) const;

  const CellLattice& lattice() const { return lattice_; }
  const CellFabric& fabric() const { return fabric_; }
  const HeldSides& held() const { return held_; }
  /// Half weights of the cells beside each side [N].
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  const CellLattice& lattice_;
  const CellFabric& fabric_;
  const HeldSides& held_;
  bool exact_;
  Eigen::VectorXd weights_;
};

}  // namespace palpate::tissue
