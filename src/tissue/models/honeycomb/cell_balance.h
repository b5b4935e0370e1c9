// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "cell_fabric.h"
#include "cell_lattice.h"

namespace palpate::tissue {

/// Unknowns of a lattice of cells.
struct CellState {
  Eigen::VectorXd sides;      ///< Displacement of each side along its positive axis [m].
  Eigen::VectorXd pressures;  ///< Fluid pressure at the centre of each cell [Pa].
  Eigen::VectorXd turns;      ///< Rotation of cell c about axis a, at 3 c + a [rad].
};

/// Equations of a lattice of cells: forces on sides and volume of the fluid [Wang 2005,
/// eq. 3.2-3.11, signs as below], torques on cells (3.12-3.19). With the displacement d of a side
/// along its axis i, edges L = l + d^+ - d^-, and A_i = V / l_i or, exact, L_j L_m:
///
///   F = [P A - k (L - l)] of the cell before - the same of the cell behind
///       - sum_n t_n (d - d_n) - t_held d + rho V g_i / 2 of each cell + load
///   volume:  sum_i A_i (L_i - l_i) = 0,  exact:  L_1 L_2 L_3 - V = 0
///
/// With the cell's own area the fluid's forces on it cancel; (3.5) has the mean of both cells. Half
/// weights are the hydrostatic pressure relative to the centre (3.6), with the slope at rest.
class CellBalance {
 public:
  /// `weight`: of each cell in O, 3 x m [N].
  /// @pre All arguments outlive this.
  CellBalance(const CellLattice& lattice, const CellFabric& fabric, const HeldSides& held,
              const Points& weight, bool exact);

  CellState rest() const;
  /// Force on a side along its axis, without contact [N].
  double force(const CellState& state, int side) const;
  /// Torque on a cell, at 3 cell + axis, without contact [N m].
  double torque(const CellState& state, int turn) const;
  /// Excess volume of a cell [m^3].
  double volumeError(const CellState& state, int cell) const;
  /// Edges of a cell [m], and areas of its pressure by axis [m^2].
  Vec3 edges(const CellState& state, int cell) const;
  Vec3 areas(const CellState& state, int cell) const;
  /// Energy of a state [J].
  double elasticEnergy(const CellState& state) const;
  /// Least ratio over all cells of volume or edge to the value at rest [-].
  double leastRatio(const CellState& state) const;

  /// Solves for a cell's `passive` sides and pressure: 7 - m unknowns for m active sides. Linear
  /// volumes: one solve; exact: `steps` of Newton's method with constant areas. Returns the largest
  /// change [m]; does nothing without passive sides. `load`: on each side [N].
  double solveCell(int cell, const std::array<bool, 6>& passive, const Eigen::VectorXd& load,
                   int steps, CellState* state) const;
  /// Solves for a cell's rotations that are not `controlled`; `load`: on each rotation [N m].
  void solveTurns(int cell, const std::vector<bool>& controlled, const Eigen::VectorXd& load,
                  CellState* state) const;

  const CellLattice& lattice() const { return lattice_; }
  const CellFabric& fabric() const { return fabric_; }
  const HeldSides& held() const { return held_; }
  /// Half weights of the cells at each side [N].
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  const CellLattice& lattice_;
  const CellFabric& fabric_;
  const HeldSides& held_;
  bool exact_;
  Eigen::VectorXd weights_;
};

}  // namespace palpate::tissue
