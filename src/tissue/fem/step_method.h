// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "fem_body.h"
#include "palpate/base/state_bytes.h"
#include "palpate/mesh/mesh_change.h"

namespace palpate::tissue {

class BodyMotion;

/// How a body gets from one cycle's end to the next one's. A method keeps a reference to its body
/// and scratch memory of its own.
class StepMethod {
 public:
  virtual ~StepMethod() = default;

  /// Goes on by `dt` [s] while the tools go their way (body.tool_path, which has begun and
  /// searched). Writes body.x, body.v and what it did into `out`: status, iterations, residual,
  /// tolerance. False: it failed, and x and v are where they were.
  virtual bool advance(double dt, TissueStep* out) = 0;
  /// After advance(): the contacts at its end and the forces of support and inertia, into `out`.
  virtual void reportForces(TissueStep* out) = 0;
  /// Norm of the forces that would begin to move the body if it were stopped here [N].
  virtual double unbalancedForce() = 0;
  /// Whether the least push would not have it leave where it came to rest; asked then, of methods
  /// that look for a root of forces.
  virtual bool restsInMinimum() { return true; }
  /// Kinetic energy is computed with these, n [kg].
  virtual const Eigen::VectorXd& masses() const = 0;
  /// At body.x [J], of a method with another elasticity than the body's own.
  virtual std::optional<double> elasticEnergy() const { return std::nullopt; }
  /// Moves `x`, the body's equilibrium under gravity, to that of such a method, 3 x n [m].
  virtual void moveToEquilibrium(Points* /*x*/) {}
  /// Does what the first cycle, of `dt` [s], would have to do before it can begin, as a first
  /// factorisation, from where the body is.
  virtual void prepare(double /*dt*/) {}

  /// The body's motion, by which it can also be stepped together with other bodies. Null: of a
  /// method that has none.
  virtual BodyMotion* motion() { return nullptr; }
  /// Forgets what it learnt about solving: the body's motion is in other hands for a while.
  virtual void forget() {}

  /// body.x and body.v were set from outside.
  virtual void restart() = 0;
  /// The body goes on from where that of `old` is, on another mesh, and so does the method, which
  /// is of the same name; body.x and body.v are there already. What it prepared, it keeps. By
  /// default it restarts.
  virtual void goOnFrom(const StepMethod& /*old*/, const mesh::MeshChange& /*change*/) {
    restart();
  }
  /// body.v was set to zero, and x is at rest.
  virtual void stop() = 0;

  /// All memory beside the body's own.
  virtual void save(StateWriter* out) const = 0;
  /// The body's own is that of the same moment.
  /// @throws std::invalid_argument for the memory of another method or of another body.
  virtual void restore(StateReader* in) = 0;
};

/// `name`: one of methodNames(); body.method becomes it, or what `auto` took.
/// @throws std::invalid_argument for another one, for a body or settings that the method does not
/// take (methodFacts()), and for what its constructor refuses.
std::unique_ptr<StepMethod> makeStepMethod(const std::string& name, FemBody* body);

}  // namespace palpate::tissue
