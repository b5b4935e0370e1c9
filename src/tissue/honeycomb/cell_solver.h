// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cell_waves.h"
#include "contact_sides.h"
#include "palpate/contact/contact_potential.h"
#include "palpate/solver/interrupt.h"
#include "palpate/solver/status.h"
#include "palpate/tissue/honeycomb/honeycomb_settings.h"
#include "wave_mixing.h"

namespace palpate::tissue {

/// What a solve came to.
struct CellSolve {
  solver::SolveStatus status = solver::SolveStatus::kIterationLimit;
  int waves = 0;
  int cells = 0;              ///< Solved, in all waves.
  double residual = 0.0;      ///< Norm of what is unbalanced [N].
  double volume_error = 0.0;  ///< Largest of a cell, over its volume at rest.
};

/// Quasi-static solves of a lattice of cells under contact: control sides, a wave, mixing, until no
/// side moves farther in a wave than the threshold and what is unbalanced is within the tolerance,
/// as is what volumes lack. Of cells that the cut-off leaves out nothing is asked.
class CellSolver {
 public:
  /// `tolerance` [N]. All that are classes are kept by reference.
  CellSolver(const CellBalance& balance, const CornerMap& map,
             const contact::ContactPotential& contact, const HoneycombSettings& settings,
             double tolerance);

  /// `whole`: no cell is left out.
  CellSolve solve(int max_waves, const solver::Interrupt* interrupt, CellState* state,
                  bool whole = false);

  /// All memory between solves.
  CellWaves& waves() { return waves_; }
  const CellWaves& waves() const { return waves_; }

  /// Forces on corners of contact at x, world, 3 x n [N], as sides and turns get them.
  void contactForces(const Points& x, Points* f) const;
  /// What is unbalanced on sides and turns that are not held, of cells that have been reached, or
  /// `everywhere` [N]; `volume_error` as in CellSolve.
  double unbalanced(const CellState& state, bool everywhere, double* volume_error);

 private:
  void pack(const CellState& state, Eigen::VectorXd* x) const;
  void unpack(const Eigen::VectorXd& x, CellState* state) const;
  bool counts(int side) const;
  double unbalancedHere(const CellState& state, bool everywhere, double* volume_error);
  bool stayOutside(const Eigen::VectorXd& from, CellState* state);

  const CellBalance& balance_;
  const CornerMap& map_;
  const contact::ContactPotential& contact_;
  HoneycombSettings settings_;
  double tolerance_;
  CellWaves waves_;
  ContactSides contact_sides_;
  WaveMixing mixing_;
  CellControl control_;
  int solved_ = 0;                          // cells, in the last wave
  std::vector<bool> fronts_of_, turns_of_;  // control sides and turns that fronts began from
  double pressure_scale_, turn_scale_;      // to [m]
  Eigen::VectorXd begin_, middle_, end_, trial_, moved_, sides_, turns_;
  Points x_, next_, f_;
};

}  // namespace palpate::tissue
