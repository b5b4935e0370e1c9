// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell_waves.h"
#include "corner_map.h"
#include "dense_saddle.h"
#include "palpate/contact/contact_potential.h"

namespace palpate::tissue {

/// The control sides of a lattice: those, and the turns, that move corners which tools touch. They
/// are brought to where they balance with contact, together with the other sides and the pressures
/// of their cells, while all else stays: Newton's method on a small dense matrix, so that tools do
/// not go into cells whatever their shape.
class ContactSides {
 public:
  /// All are kept by reference.
  ContactSides(const CellBalance& balance, const CornerMap& map,
               const contact::ContactPotential& contact);

  /// The factors of matrices serve as long as they help; without those of an earlier solve.
  void forget() { factored_.clear(); }
  /// Moves them, and with the state its corners x, 3 x n [m], until no more than `tolerance` [N] is
  /// unbalanced among them, marks them in `control`, beside what is held, and says how far each
  /// side went, `moved` [m]. False: nothing touches.
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

  std::vector<int> local_;                  // of each unknown, or -1
  std::vector<int> cell_local_;             // of each cell, or -1
  std::vector<int> unknowns_, cells_;       // that are solved for
  int num_touched_ = 0;                     // of the unknowns, first: they move what is touched
  std::vector<contact::Contact> contacts_;  // in the state that is solved, or tried
  Points x_, d_;                            // corners, and a step of them [m]
  DenseSaddle matrix_;
  std::vector<int> factored_;  // unknowns that the matrix is factored for; empty: none
  std::vector<double> g_, v_, y_, p_;
  struct Entry {
    int local;
    Vec3 by;  // of a sample by an unknown, in world
  };
  std::vector<Entry> entries_;
  CellState trial_;
};

}  // namespace palpate::tissue
