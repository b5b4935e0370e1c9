// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "palpate/sim/simulator.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// A completed cycle.
struct Cycle {
  const sim::Simulator& simulator;
  const sim::StepResult& result;
  std::size_t row;  ///< Row of the trajectory.
  double dt;        ///< Time step of that row [s].
  int parts;        ///< Number of steps of the cycle.
};

/// A requirement on a scene; an instance checks all cycles of one run.
class Criterion {
 public:
  virtual ~Criterion() = default;
  /// Describes the violation by this cycle; empty if there is none.
  virtual std::string check(const Cycle& cycle) = 0;
  /// Called after the first cycle, when organs were moved to the scene's initial positions.
  virtual void placed(const sim::Simulator& /*simulator*/) {}
  /// Describes a violation by the whole run; empty if there is none.
  virtual std::string finish() { return ""; }
};

/// A criterion with its name.
struct NamedCriterion {
  std::string name;
  std::unique_ptr<Criterion> criterion;
};

/// All criteria of a run of `scene`, for a simulator before its first step:
///
///   finite    no number is NaN or infinite, and no status is non_finite
///   bounded   no point is ten sizes away, and no force is beyond tissue of that stiffness
///   inverted  no cycle reported as converged has a tetrahedron with det F <= 0 at its corners
///   truth     status, residual and wrench follow from points and contacts
///   wrench    forces come from touches, and those at the hand are within the limits
///   energy    without tools it grows by no more than the integrator's bound
///   rest      without tools, damped and held, all returns within 1e-4 of its size
///   time      no cycle takes 100 times the median one in contact (and 20 ms)
std::vector<NamedCriterion> criteria(const TortureScene& scene, const sim::Simulator& simulator);

/// Names of the criteria, and of failures of a run itself: crash; cycle (one was stopped as too
/// long); deadline (a live cycle exceeded it); same (another number of threads gave other bits);
/// cut (another criterion failed with cycles cut short).
std::vector<std::string> criterionNames();

}  // namespace palpate::torture
