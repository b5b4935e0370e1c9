// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "fem_body.h"
#include "palpate/base/state_bytes.h"
#include "palpate/mesh/mesh_change.h"

namespace palpate::tissue {

class BodyMotion;

/// Time stepping over a cycle of a body, or of the members of a group as one.
class CycleSolver {
 public:
  virtual ~CycleSolver() = default;

  /// Steps the bodies over `dt` [s] while the tools move along body.tool_path. Writes body.x,
  /// body.v, and status, iterations, residual and tolerance to `out`. Returns false on failure; x
  /// and v are then unchanged.
  /// @pre ToolContact::begin().
  virtual bool advance(double dt, TissueStep* out) = 0;
  /// Writes contacts, support and inertia forces of a member at the cycle's end to `out`.
  /// @pre advance().
  virtual void reportForcesOn(std::size_t member, TissueStep* out) = 0;
  /// Norm of the static forces at the present positions with zero velocity [N].
  virtual double unbalancedForce() = 0;
  /// Whether the equilibrium is stable; meaningful for methods that solve for zero forces.
  virtual bool restsInMinimum() { return true; }
};

/// Time stepping of a body over a cycle. A method holds a reference to its body, and buffers.
class StepMethod : public CycleSolver {
 public:
  /// See reportForcesOn(); of the body.
  virtual void reportForces(TissueStep* out) = 0;
  void reportForcesOn(std::size_t, TissueStep* out) final { reportForces(out); }
  /// Nodal masses for the kinetic energy, n [kg].
  virtual const Eigen::VectorXd& masses() const = 0;
  /// Elastic energy at body.x [J], of a method with its own elasticity.
  virtual std::optional<double> elasticEnergy() const { return std::nullopt; }
  /// Moves `x`, the body's equilibrium, 3 x n [m], to that of a method with its own elasticity.
  virtual void moveToEquilibrium(Points* /*x*/) {}
  /// Prepares the solver for cycles of `dt` [s] at the present positions, such as a factorisation.
  virtual void prepare(double /*dt*/) {}

  /// Motion of the body, for steps in groups; null: not supported.
  virtual BodyMotion* motion() { return nullptr; }
  /// Drops cached solver state: a BodyGroup integrates this body from now on.
  virtual void forget() {}

  /// Resets after body.x and body.v were set.
  virtual void restart() = 0;
  /// Takes over the state of `old`, the same method before the mesh adaptation `change`, but keeps
  /// prepare(). Default: restart().
  /// @pre body.x and body.v are transferred.
  virtual void goOnFrom(const StepMethod& /*old*/, const mesh::MeshChange& /*change*/) {
    restart();
  }
  /// Resets velocities: body.v was set to zero at rest.
  virtual void stop() = 0;

  /// Writes the state in addition to the body's.
  virtual void save(StateWriter* out) const = 0;
  /// Reads the state.
  /// @pre The body's state is of the same cycle.
  /// @throws std::invalid_argument for the state of another method or body.
  virtual void restore(StateReader* in) = 0;
};

}  // namespace palpate::tissue
