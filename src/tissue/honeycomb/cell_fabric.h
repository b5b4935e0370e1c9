// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell_lattice.h"

namespace palpate::tissue {

/// What is held of a lattice: sides do not move, and cells do not turn against what holds a side.
struct HeldSides {
  std::vector<bool> along_normal;  ///< Of each side: all of its corners are held along its normal.
  std::vector<bool> all;           ///< All of its corners are held in all directions.
};

/// `free`: of the corners in O, 3 x n, 1 or 0.
HeldSides heldSides(const CellLattice& lattice, const Eigen::Matrix3Xd& free);

/// A spring between two unknowns of one kind.
struct Coupling {
  int other;
  double stiffness;
};

/// The elastic fabric of the cells' walls, whose stiffnesses Wang (2005) leaves open; here those of
/// an isotropic incompressible solid with the shear modulus G [Pa] in each cell of volume V and
/// edges l. A cell has the energy V G eps : eps, of which
///
///   k_i  = 2 G V / l_i^2   resists stretch of its walls along axis i: with its fluid a column has
///                          Young's modulus 3 G;
///   t_ij = G V / l_j^2     resists shear of walls normal to axis i between neighbours along j, one
///                          half of it on each of the cell's two walls: a slab has the modulus G.
///
/// A held side holds the walls that end on it, half a cell away: by twice as much.
///
/// Turned about axis i against its neighbour along axis j a cell is resisted by [Wang 2005, eq.
/// 3.16-3.18 with the fabric spread over the cell]; a held side is like a neighbour that does not
/// turn:
///
///   j != i:  (1/24) (k_j + k_j') l_m^2 + (l_j^2 / 2) (t_mj^+ + t_mj^-),  m the third axis;
///   j = i:   (1/6) sum over the other axes m, n of (t_mi^+ + t_mi^-) l_n^2.
///
/// (3.16) has 1/6 in the place of 1/24, which follows from 1/3 in (3.14) for the second moment of
/// the fabric; spread evenly it is 1/12.
struct CellFabric {
  std::vector<Vec3> stretch;                   ///< k of each cell [N/m].
  std::vector<std::vector<Coupling>> shear;    ///< Of each side [N/m].
  Eigen::VectorXd shear_to_held;               ///< Of each side to what is held [N/m].
  std::vector<std::vector<Coupling>> turning;  ///< Of unknown 3 cell + axis [N m].
  Eigen::VectorXd turning_to_held;             ///< Likewise.
  // Sums of all above: of a side with its own stretch, and of a turn.
  Eigen::VectorXd diagonal;
  Eigen::VectorXd turning_diagonal;
};

/// `shear_modulus`: of each cell [Pa].
CellFabric makeCellFabric(const CellLattice& lattice, const HeldSides& held,
                          const std::vector<double>& shear_modulus);

}  // namespace palpate::tissue
