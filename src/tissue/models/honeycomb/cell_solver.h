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

/// Result of a solve.
struct CellSolve {
  solver::SolveStatus status = solver::SolveStatus::kIterationLimit;
  int waves = 0;
  int cells = 0;              ///< Solved cells, summed over waves.
  double residual = 0.0;      ///< Norm of the unbalanced forces [N].
  double volume_error = 0.0;  ///< Largest relative volume error of a cell [-].
};

/// Quasi-static solver of a lattice under contact: control sides, a wave and mixing, until side
/// displacements per wave, residual and volume errors are within limits. Cells below the cut-off
/// are skipped.
class CellSolver {
 public:
  /// `tolerance`: of the residual [N].
  /// @pre Arguments of class type outlive this.
  CellSolver(const CellBalance& balance, const CornerMap& map,
             const contact::ContactPotential& contact, const HoneycombSettings& settings,
             double tolerance);

  /// Solves; `whole`: without skipped cells.
  CellSolve solve(int max_waves, const solver::Interrupt* interrupt, CellState* state,
                  bool whole = false);

  /// Writes the state between solves.
  CellWaves& waves() { return waves_; }
  const CellWaves& waves() const { return waves_; }

  /// Contact forces at x, world, 3 x n [N], mapped to sides and rotations.
  void contactForces(const Points& x, Points* f) const;
  /// Residual of free sides and rotations of reached cells, or `everywhere` [N]; `volume_error` as
  /// in CellSolve.
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
  int solved_ = 0;                          // cells in the last wave
  std::vector<bool> fronts_of_, turns_of_;  // control sides and rotations where fronts begin
  double pressure_scale_, turn_scale_;      // scales to lengths
  Eigen::VectorXd begin_, middle_, end_, trial_, moved_, sides_, turns_;
  Points x_, next_, f_;
};

}  // namespace palpate::tissue
