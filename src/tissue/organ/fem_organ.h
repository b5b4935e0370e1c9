// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "failure_backoff.h"
#include "organ_bodies.h"
#include "palpate/mesh/mesh_change.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "tissue/body/fem_body.h"
#include "tissue/body/step_method.h"
#include "tissue/touch/rest.h"

namespace palpate::tissue {

/// Parts of a body of another model than finite elements.
struct OwnParts {
  std::string name;                             ///< Name in states, instead of the element's.
  std::shared_ptr<fem::Elasticity> elasticity;  ///< Elasticity; null: that of settings.element.
  /// Maker of the step method; empty: settings.method.
  std::function<std::unique_ptr<StepMethod>(FemBody*)> method;
  std::vector<std::string> notes;  ///< Decisions that concern the user, a line each.
  Eigen::Matrix3Xi surface = {};   ///< Surface; without columns: boundary of the tetrahedra.
  /// Additional load that depends on positions alone; null: none.
  std::shared_ptr<const fem::EnergyTerm> load = nullptr;
  /// Samples of contact; none: samples of the surface.
  std::vector<contact::SurfaceSample> samples = {};
  Points start = {};  ///< Initial positions, 3 x n [m]; without columns: the equilibrium.
};

/// A finite element body with its step method, sleep, recovery from failures and report:
/// makeFemTissue().
class FemOrgan final : public OrganBodies {
 public:
  /// Begins in the rest configuration, without gravity.
  FemOrgan(const mesh::TetMesh& mesh, const fem::Composition& composition,
           const Surroundings& surroundings, const FemSettings& settings, ThreadPool* pool,
           const Eigen::Matrix3Xi& surface = {}, const OwnParts& own = {});

  /// Moves to the equilibrium under gravity, or to OwnParts::start, and stores it for reset().
  /// @throws as makeFemTissue()
  void findEquilibrium();
  /// Takes over positions, velocities and state of `old`, the same body before the mesh adaptation
  /// `change`. Keeps the equilibrium and the solver state of prepareAt().
  void goOnFrom(const FemOrgan& old, const mesh::MeshChange& change);
  /// Whether goOnFrom() keeps the least det F above half of that of `old`, and a finite energy.
  bool canGoOnFrom(const FemOrgan& old, const mesh::MeshChange& change) const;

  SurfaceState surfaceState(int) const override { return {body_.x, body_.v, body_.triangles, 0}; }
  mesh::CellMesh cells(int) const override { return body_.cells(); }
  std::vector<std::string> methods(int) const override;
  std::vector<std::string> notes() const override;
  void setInterrupt(const solver::Interrupt* interrupt) override { body_.interrupt = interrupt; }
  void reset() override;
  void setPositions(int, const Points& positions, const Points& velocities) override;
  State state() const override;
  void restore(const State& state) override;
  /// Moves to x, 3 x n [m], with zero velocity, and prepares the method for cycles of `dt` [s].
  void prepareAt(const Points& x, double dt);
  void addBodies(std::vector<FemOrgan*>* bodies) override { bodies->push_back(this); }
  const TissueStep& endCycle(const std::vector<contact::Obstacle>&, double) override {
    return out_;
  }

  const FemBody& body() const { return body_; }
  /// Initial equilibrium without contact, 3 x n [m].
  const Points& equilibrium() const { return equilibrium_; }
  void setEquilibrium(Points x) { equilibrium_ = std::move(x); }
  /// Begins a cycle of `dt` [s]; stepAlone() or a BodyGroup continues it by solveCycle().
  void begin(const std::vector<contact::Obstacle>& obstacles, double dt);
  /// Solves the cycle by the body's own method.
  void stepAlone(double dt);
  /// Result of the cycle.
  const TissueStep& report() const { return out_; }
  /// Ends sleep until the next solved cycle.
  void wake() { rest_.wake(); }

  /// See contact::ContactPotential::setOffsets().
  void setContactOffsets(const Points& offsets) { body_.contact.setOffsets(offsets); }

  /// Motion for groups; null: the method steps alone.
  BodyMotion* motion() { return method_->motion(); }
  /// Drops cached solver state: a BodyGroup integrates this body from now on.
  void join() { method_->forget(); }
  /// Adds the group's iterations and times to this member's report.
  void addWork(const TissueStep& of_group);

  // Interface for solveCycle().
  /// Whether the body sleeps in the cycle.
  bool sleeps() const { return rest_.sleeps(body_.tool_contact); }
  /// Reports the cycle as asleep.
  void sleepOn() { rest_.report(&out_); }
  /// Whether backoff skips the cycle. Called once a cycle.
  bool isFrozen() { return backoff_.holds(isTouched()); }
  /// Whether backoff is active, and the status of the last failure.
  bool isFailing() const { return backoff_.fails(); }
  solver::SolveStatus failure() const { return backoff_.status(); }
  /// Skips the cycle; `why`: the failure of this body or of another member.
  void stayFrozen(solver::SolveStatus why);
  /// Begins a solved cycle.
  void beginSolve() { rest_.begin(body_.x); }
  /// Whether the body is still after a solve with result `solved`.
  bool isStill(const TissueStep& solved) const {
    return rest_.isStill(body_.x, body_.tool_contact, solved);
  }
  /// Whether a tool may touch the body in this cycle.
  bool isTouched() const { return body_.tool_contact.possibleByTools(); }
  /// True if the body should be reset: it rests with inverted elements, or stayed inverted without
  /// progress. A body that is inverted again after a reset is compressed by its loads: it stays,
  /// and cycles without progress count as failures.
  /// @pre Called once after a solved cycle, without a tool near the group.
  bool shouldReset(const TissueStep& cycle, bool at_rest);
  /// A tool was near the group: allows another reset.
  void reached() { was_inverted_ = false; }
  /// Ends a cycle by a reset to the equilibrium, displaced with its supports, as of all members.
  void endReset(const TissueStep& solved, solver::SolveStatus why);
  /// Ends a solved cycle; `at_rest`: all members rest; `member`: index of this one.
  void endSolved(const TissueStep& solved, bool at_rest, CycleSolver* solver, std::size_t member);
  /// Whether a failure with `status` is permanent.
  bool failsForGood(solver::SolveStatus status) const {
    return status != solver::SolveStatus::kDeadline && backoff_.isForGood();
  }
  /// Ends a failed cycle; `for_good`: permanent for all members.
  void endFailed(const TissueStep& failed, bool for_good);

 private:
  void put(const Points& positions, const Points& velocities);
  bool isCrushed();
  bool isStuck(const TissueStep& cycle);
  double wayOfShape() const;
  bool isOutsideOfLaw() const;
  solver::SolveStatus failureHere() const;
  void resetToEquilibrium(solver::SolveStatus why);
  void fallAsleep();
  void fail();
  void stop();
  void takeFigures(const TissueStep& solved);
  void reportSolved();
  void finishCycle();

  static constexpr double kNotStuck = 1.0;

  std::shared_ptr<const fem::EnergyTerm> own_load_;
  FemBody body_;
  std::unique_ptr<StepMethod> method_;
  Rest rest_;
  FailureBackoff backoff_;
  bool stuck_ = false;           // inverted without progress, in this cycle
  double stuck_at_ = kNotStuck;  // least det F when that began
  bool was_inverted_ = false;    // and reset, since the last valid rest or near tool
  Points equilibrium_;
  double contact_force_ = 0.0, support_force_ = 0.0;  // of body_ at the cycle's begin [N]
  bool own_method_, own_start_;
  std::vector<std::string> own_notes_;
  TissueStep out_;
  const std::vector<FemOrgan*> alone_ = {this};  // members of stepAlone()
};

/// Solves a cycle of `dt` [s] of the members of a group, or of a single body. `solver` steps the
/// members as one, and all of them sleep, fail or are reset as one. `out`: result of the solve; of
/// a single body its report.
/// @pre FemOrgan::begin() of all members.
void solveCycle(const std::vector<FemOrgan*>& members, CycleSolver* solver, double dt,
                TissueStep* out);

/// As makeFemTissue().
std::unique_ptr<FemOrgan> makeFemOrgan(const mesh::TetMesh& mesh,
                                       const fem::Composition& composition,
                                       const Surroundings& surroundings,
                                       const FemSettings& settings, ThreadPool* pool,
                                       const OwnParts& own = {});

}  // namespace palpate::tissue
