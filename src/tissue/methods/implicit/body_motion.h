// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/solver/block_pcg.h"
#include "palpate/solver/integrator.h"
#include "palpate/solver/potential.h"
#include "tissue/body/fem_body.h"

namespace palpate::tissue {

/// Implicit steps of one body: integrator, incremental potential over its points, and rollback to
/// the cycle's begin, but for tool contact. ImplicitSteps solves it alone or in a group.
class BodyMotion {
 public:
  /// @pre `body` outlives this.
  explicit BodyMotion(FemBody* body);
  BodyMotion(const BodyMotion&) = delete;  // the potential refers to the integrator
  BodyMotion& operator=(const BodyMotion&) = delete;

  FemBody& body() { return body_; }
  const FemBody& body() const { return body_; }
  /// Incremental potential of the present step: inertia, elasticity, loads, contact.
  const solver::Potential& potential() const { return potential_; }
  /// Conjugate gradient solver of the body, whose order and coarse space groups use; null: none.
  solver::BlockPcg* pcg = nullptr;

  const Eigen::VectorXd& masses() const { return integrator_.masses(); }

  /// Resets the integrator after body.x and body.v were set.
  void restart();
  /// Takes over the integrator of `old`, of the same body before a mesh adaptation.
  /// @pre body.x and body.v are transferred.
  void goOnFrom(const BodyMotion& old, const mesh::MeshChange& change);
  void stop() { integrator_.stop(); }

  /// Begins a cycle; goBack() rolls back to here until endCycle().
  void beginCycle();
  void goBack();
  void endCycle();

  /// Begins a step of `h` [s] at body.x and fraction `begin` of the cycle.
  void beginStep(double begin, double h);
  /// Ends the step at body.x with a residual of `unbalanced` [N].
  void endStep(double unbalanced);
  /// Extrapolated displacement of free nodes in `h` [s], 3 x n [m].
  void extrapolate(double h, Points* way) const;
  /// Value of the potential at body.x [J]; reuses a known elastic energy.
  double valueHere();

  /// Squared norm of the static forces at body.x with zero velocity [N^2]; `gradient`: of the
  /// potential, 3 x n [N].
  double squaredUnbalancedForce(const Points& gradient);
  /// Writes contacts at body.x, support and inertia forces into `out`.
  void reportForces(const Points& gradient, TissueStep* out);

  void save(StateWriter* out) const { integrator_.save(out); }
  void restore(StateReader* in) { integrator_.restore(in); }

 private:
  FemBody& body_;
  solver::Integrator integrator_, begin_;  // of the step, of the cycle's begin
  solver::Potential potential_;
  std::unique_ptr<fem::ViscousState> viscous_;  // at the cycle's begin
  Points elastic_gradient_, inertia_forces_;
};

}  // namespace palpate::tissue
