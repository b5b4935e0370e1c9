// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "palpate/fem/inversion_guard.h"
#include "palpate/torture/criteria.h"
#include "textbook_solid.h"

namespace palpate::torture {

/// Residual at the nodes, recomputed from the states before and after a cycle and the reported
/// contacts. For one organ of elements without viscosity, in cycles of a single implicit step, when
/// all forces are known (docs/theory.md, Time). A cycle by bdf2 may have used backward Euler, for
/// example after a change of the step.
class RecomputedResidual {
 public:
  RecomputedResidual(const TortureScene& scene, const sim::Simulator& simulator);

  /// Whether cycles of the scene can be checked.
  bool knows() const { return solid_ != nullptr; }
  /// Describes a wrong residual of a cycle reported as converged; "" if it is right.
  std::string check(const Cycle& cycle);
  /// Stores the initial state of the next cycle.
  void remember(const sim::Simulator& simulator);
  /// Number of checked cycles.
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
  Points x_, v_;                // at the begin of the cycle
  Points x_before_, v_before_;  // at the begin of the previous cycle
  int checked_ = 0;
};

}  // namespace palpate::torture
