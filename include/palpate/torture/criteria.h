// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "palpate/sim/simulator.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// A cycle that was done.
struct Cycle {
  const sim::Simulator& simulator;
  const sim::StepResult& result;
  std::size_t row;  ///< Of the trajectory.
  double dt;        ///< Of that row [s].
  int parts;        ///< Steps that it was cut into.
};

/// What a scene must not do. One of these sees all cycles of one run.
class Criterion {
 public:
  virtual ~Criterion() = default;
  /// What is wrong with the cycle, or nothing.
  virtual std::string check(const Cycle& cycle) = 0;
  /// The organs were put elsewhere after the first cycle, for that is where the scene begins.
  virtual void placed(const sim::Simulator& /*simulator*/) {}
  /// What is wrong with all of them.
  virtual std::string finish() { return ""; }
};

/// One of them with its name.
struct NamedCriterion {
  std::string name;
  std::unique_ptr<Criterion> criterion;
};

/// All of them, for a run of `scene` by a simulator that made no step yet:
///
///   finite    no number is NaN or infinite, and no status non_finite
///   bounded   no point is ten sizes away, and no force more than tissue of that stiffness has
///   inverted  no shape with a tetrahedron of det F <= 0, as computed from its corners, is
///   converged truth     status, residual and wrench are what follows from points and contacts
///   wrench    forces come from what touches, and what reaches the hand is within the limits
///   energy    without tools it grows by no more than the integrator's bound
///   rest      without tools, damped and held, all is back within 1e-4 of its size
///   time      no cycle takes 100 times as long as the median one in contact (and 20 ms)
std::vector<NamedCriterion> criteria(const TortureScene& scene, const sim::Simulator& simulator);

/// Their names, and those of what a run itself can do: crash, cycle (one took too long and was
/// ended), deadline (a live one went on after it), same (another number of threads gave other
/// bits), cut (with cycles that end before their time something else was not met).
std::vector<std::string> criterionNames();

}  // namespace palpate::torture
