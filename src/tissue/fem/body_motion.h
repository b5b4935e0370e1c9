// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "fem_body.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/integrator.h"
#include "palpate/solver/potential.h"

namespace palpate::tissue {

/// A body in implicit steps: how it goes on by itself, what of that is minimised over its points,
/// and the way back to where a cycle began. Whether a step is solved for this body alone or for
/// several, see ImplicitSteps.
class BodyMotion {
 public:
  /// `body` must outlive this.
  explicit BodyMotion(FemBody* body);
  BodyMotion(const BodyMotion&) = delete;  // the potential refers to the integrator
  BodyMotion& operator=(const BodyMotion&) = delete;

  FemBody& body() { return body_; }
  const FemBody& body() const { return body_; }
  /// Inertia, elasticity, loads and contact in the step under way.
  const solver::Potential& potential() const { return potential_; }
  /// The body's own conjugate gradients, in whose order and with whose coarse space it can be
  /// solved together with others; null: it has none.
  solver::BlockPcg* pcg = nullptr;

  const Eigen::VectorXd& masses() const { return integrator_.masses(); }

  /// body.x and body.v were set from outside.
  void restart();
  /// Goes on where `old` was, which is of the same body on another mesh; body.x and body.v are
  /// there already.
  void goOnFrom(const BodyMotion& old, const mesh::MeshChange& change);
  void stop() { integrator_.stop(); }

  /// A cycle begins, and it can goBack() to here until it ends.
  void beginCycle();
  void goBack();
  void endCycle();

  /// A step of `h` [s] begins at body.x, at part `begin` of the cycle.
  void beginStep(double begin, double h);
  /// It has ended at body.x, with forces out of balance by `unbalanced` [N].
  void endStep(double unbalanced);
  /// Where the free nodes come in `h` [s] if they go on as they do, 3 x n [m].
  void extrapolate(double h, Points* way) const;
  /// The sum of all potentials at body.x, of which the elastic energy may be known.
  double valueHere();

  /// Squared norm of the forces that would begin to move the body if it were stopped at body.x,
  /// where the potential has `gradient` [N^2].
  double squaredUnbalancedForce(const Points& gradient);
  /// The contacts at body.x and the forces of support and inertia, into `out`.
  void reportForces(const Points& gradient, TissueStep* out);

  void save(StateWriter* out) const { integrator_.save(out); }
  void restore(StateReader* in) { integrator_.restore(in); }

 private:
  FemBody& body_;
  solver::Integrator integrator_, begin_;  // of the step, of the cycle
  solver::Potential potential_;
  std::unique_ptr<fem::ViscousState> viscous_;  // of the cycle's begin
  StateWriter touched_;                         // likewise
  Points elastic_gradient_, inertia_forces_;
};

}  // namespace palpate::tissue
