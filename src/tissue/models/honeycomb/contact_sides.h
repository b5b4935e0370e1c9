// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell_waves.h"
#include "corner_map.h"
#include "dense_saddle.h"
#include "palpate/contact/contact_potential.h"

namespace palpate::tissue {

/// Control sides of a lattice: sides and rotations that move touched corners. Newton's method with
/// a dense matrix solves for them and for the other sides and pressures of their cells, with
/// contact.
class ContactSides {
 public:
  /// @pre All arguments outlive this.
  ContactSides(const CellBalance& balance, const CornerMap& map,
               const contact::ContactPotential& contact);

  /// Drops the factors of earlier solves.
  void forget() { factored_.clear(); }
  /// Solves for the control sides, state and corners x, 3 x n [m], to a residual of `tolerance`
  /// [N]; marks them in `control` and writes displacements to `moved` [m]. Returns false without
  /// contact.
  bool solve(double tolerance, CellState* state, Points* x, CellControl* control,
             Eigen::VectorXd* moved);

 private:
  bool gather();
  void take(int unknown);
  void takeCells(int unknown);
  double unbalanced(const CellState& state);
  void findWay();
  bool step(CellState* state, Points* x);
  double slope(const CellState& state) const;
  double internalForce(const CellState& state, int unknown) const;
  void assemble(const CellState& state);
  void addContacts();

  const CellBalance& balance_;
  const CornerMap& map_;
  const contact::ContactPotential& contact_;
  int num_sides_;

  std::vector<int> local_;             // local index of each unknown, or -1
  std::vector<int> cell_local_;        // local index of each cell, or -1
  std::vector<int> unknowns_, cells_;  // of the present solve
  int num_touched_ = 0;                // number of unknowns that move touched corners, the first
  std::vector<contact::Contact> contacts_;  // of the present or trial state
  Points x_, d_;                            // corners, and their step [m]
  DenseSaddle matrix_;
  std::vector<int> factored_;  // unknowns of the factor; empty: none
  std::vector<double> g_, v_, y_, p_;
  struct Entry {
    int local;
    Vec3 by;  // derivative of a sample by an unknown, world
  };
  std::vector<Entry> entries_;
  CellState trial_;
};

}  // namespace palpate::tissue
