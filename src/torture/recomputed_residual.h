// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "palpate/fem/inversion_guard.h"
#include "palpate/torture/criteria.h"
#include "textbook_solid.h"

namespace palpate::torture {

/// What is left unbalanced at the nodes, computed anew from the shapes before and after a cycle and
/// the contacts that are told: of one organ of elements without memory, in cycles of one implicit
/// step, whose every force is known from outside (docs/theory.md, Time). A cycle by bdf2 may have
/// been one of backward Euler, as after a change of the step.
class RecomputedResidual {
 public:
  RecomputedResidual(const TortureScene& scene, const sim::Simulator& simulator);

  /// Whether cycles of the scene are looked at.
  bool knows() const { return solid_ != nullptr; }
  /// What is wrong with the residual of a cycle that was told to be converged, or "".
  std::string check(const Cycle& cycle);
  /// Where the next cycle begins.
  void remember(const sim::Simulator& simulator);
  /// Cycles that were computed anew up to now.
  int numChecked() const { return checked_; }

 private:
  bool isOneStep(const Cycle& cycle) const;
  double unbalanced(const Cycle& cycle, const Points& forces, double k, const Points& x_hat,
                    const Points& v_hat) const;
  void take(const sim::ContactPoint& point, const tissue::SurfaceState& shape,
            Points* forces) const;

  const TortureScene& scene_;
  mesh::CellMesh rest_;
  std::unique_ptr<TextbookSolid> solid_;
  std::unique_ptr<fem::InversionGuard> guard_;
  Points x_, v_;                // where the cycle begins
  Points x_before_, v_before_;  // and the one before it
  int checked_ = 0;
};

}  // namespace palpate::torture
