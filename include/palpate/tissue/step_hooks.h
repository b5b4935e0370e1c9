// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"

namespace palpate::tissue {

/// What terms of one source, tool contact or an interaction, do in the course of a cycle's steps.
/// x: positions of the term's points, 3 x n [m]. A term without state overrides holds() alone.
class StepHooks {
 public:
  virtual ~StepHooks() = default;

  /// Whether the candidates of the last search are complete at x.
  virtual bool holds(const Points& x) const = 0;
  /// A step begins at x.
  virtual void beginStep(const Points& /*x*/) {}
  /// Whether the solution x of the step needs no further augmentation; else augment() and solve
  /// again.
  virtual bool augmentationConverged(const Points& /*x*/) { return true; }
  virtual void augment(const Points& /*x*/) {}
  /// A step has ended at x.
  virtual void endStep(const Points& /*x*/) {}
  /// Updates the term by the converged solution x of a step of `h` [s], for the next step.
  virtual void learn(const Points& /*x*/, double /*h*/) {}
  /// Clears the state.
  virtual void forget() {}
  /// Writes the state between steps.
  virtual void save(StateWriter* /*to*/) const {}
  /// @throws std::invalid_argument as StateReader does.
  virtual void restore(StateReader* /*from*/) {}
};

}  // namespace palpate::tissue
