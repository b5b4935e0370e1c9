// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell_lattice.h"

namespace palpate::tissue {

/// Held sides of a lattice.
struct HeldSides {
  std::vector<bool> along_normal;  ///< Whether all corners of each side are held along its normal.
  std::vector<bool> all;           ///< Whether all corners are held in all directions.
};

/// `free`: free components of the corners in O, 3 x n, 1 or 0.
HeldSides heldSides(const CellLattice& lattice, const Eigen::Matrix3Xd& free);

/// A spring between two unknowns of one kind.
struct Coupling {
  int other;
  double stiffness;
};

/// Stiffness of the cells' elastic walls, which Wang (2005) leaves open: that of an isotropic
/// incompressible solid of shear modulus G [Pa] in a cell of volume V and edges l. The energy of a
/// cell is V G eps : eps, of which
///
///   k_i  = 2 G V / l_i^2   resists stretch along axis i: with the fluid a column has Young's
///   modulus 3 G; t_ij = G V / l_j^2     resists shear of walls normal to axis i between neighbours
///   along j, half on each
/// of a cell's two walls: a slab has the modulus G.
///
/// A held side acts on walls half a cell away, with twice the stiffness.
///
/// Stiffness of a cell's rotation about axis i against its neighbour along axis j [Wang 2005,
/// eq. 3.16-3.18 with walls spread over the cell]; a held side acts as a fixed neighbour:
///
///   j != i:  (1/24) (k_j + k_j') l_m^2 + (l_j^2 / 2) (t_mj^+ + t_mj^-),  m the third axis;
///   j = i:   (1/6) sum over the other axes m, n of (t_mi^+ + t_mi^-) l_n^2.
///
/// (3.16) has 1/6 in the place of 1/24, which follows from 1/3 in (3.14) for the second moment of
/// the fabric; spread evenly it is 1/12.
struct CellFabric {
  std::vector<Vec3> stretch;                 ///< Stretch stiffness k of each cell [N/m].
  std::vector<std::vector<Coupling>> shear;  ///< Shear couplings of each side [N/m].
  Eigen::VectorXd shear_to_held;             ///< Shear stiffness of each side to supports [N/m].
  std::vector<std::vector<Coupling>>
      turning;                      ///< Rotational couplings of unknown 3 cell + axis [N m].
  Eigen::VectorXd turning_to_held;  ///< Rotational stiffness to supports [N m].
  // Total stiffness of each side, with stretch, and of each rotation.
  Eigen::VectorXd diagonal;
  Eigen::VectorXd turning_diagonal;
};

/// `shear_modulus`: of each cell [Pa].
CellFabric makeCellFabric(const CellLattice& lattice, const HeldSides& held,
                          const std::vector<double>& shear_modulus);

}  // namespace palpate::tissue
