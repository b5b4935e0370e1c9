// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "failure_backoff.h"
#include "fem_body.h"
#include "organ_bodies.h"
#include "palpate/mesh/mesh_change.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "step_method.h"
#include "tissue/touch/rest.h"

namespace palpate::tissue {

/// What a body has that is no finite elements, or goes its own way.
struct OwnParts {
  std::string name;                             ///< For its states, instead of that of an element.
  std::shared_ptr<fem::Elasticity> elasticity;  ///< Null: that of settings.element.
  /// Its method; empty: settings.method.
  std::function<std::unique_ptr<StepMethod>(FemBody*)> method;
  std::vector<std::string> notes;  ///< What was decided, and the user should know.
  Eigen::Matrix3Xi surface = {};   ///< Without columns: that of the tetrahedra.
  /// Beside gravity and contact; null: none. Nothing but positions matters to it.
  std::shared_ptr<const fem::EnergyTerm> load = nullptr;
  /// Where contact is felt; none: samples of the surface.
  std::vector<contact::SurfaceSample> samples = {};
  Points start = {};  ///< Where it begins, at rest, 3 x n [m]; without columns: in equilibrium.
};

/// A body of finite elements that is stepped by one method, sleeps where nothing happens, and
/// reports: makeFemTissue().
class FemOrgan final : public OrganBodies {
 public:
  /// At rest in its mesh, as yet without gravity.
  FemOrgan(const mesh::TetMesh& mesh, const fem::Composition& composition,
           const Surroundings& surroundings, const FemSettings& settings, ThreadPool* pool,
           const Eigen::Matrix3Xi& surface = {}, const OwnParts& own = {});

  /// Begins at the equilibrium under gravity, or where its own parts say, which reset() goes back
  /// to from now on.
  /// @throws as makeFemTissue()
  void findEquilibrium();
  /// Goes on where `old` is, which is the same body on another mesh, of which this one's came by
  /// `change`: positions, velocities, and all memory that has a place. What reset() goes back to
  /// stays, and so does what prepareAt() made.
  void goOnFrom(const FemOrgan& old, const mesh::MeshChange& change);
  /// Whether it can: no element would be turned inside out, or lose half of the room that the least
  /// one of `old` has left, and the energy is finite.
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
  /// Is at x, 3 x n [m], at rest, and its method ready for cycles of `dt` [s] there and nearby.
  void prepareAt(const Points& x, double dt);
  void addBodies(std::vector<FemOrgan*>* bodies) override { bodies->push_back(this); }
  const TissueStep& endCycle(const std::vector<contact::Obstacle>&, double) override {
    return out_;
  }

  const FemBody& body() const { return body_; }
  /// Where it is at rest untouched at first, 3 x n [m]: where findEquilibrium() found it, or as it
  /// was told.
  const Points& equilibrium() const { return equilibrium_; }
  void setEquilibrium(Points x) { equilibrium_ = std::move(x); }
  /// A cycle of `dt` [s] begins; after that the body goes on alone, or as the member of a group.
  void begin(const std::vector<contact::Obstacle>& obstacles, double dt);
  void stepAlone(double dt);
  /// What the cycle did.
  const TissueStep& report() const { return out_; }
  /// It stays awake until it has been solved once.
  void wake() { rest_.wake(); }

  /// See contact::ContactPotential::setOffsets().
  void setContactOffsets(const Points& offsets) { body_.contact.setOffsets(offsets); }

  // As the member of a group.
  /// Null: its method steps it alone.
  BodyMotion* motion() { return method_->motion(); }
  /// It becomes one.
  void join() { method_->forget(); }
  /// Whether it would sleep through the cycle.
  bool sleeps() const { return rest_.sleeps(body_.tool_contact); }
  /// It does.
  void sleepOn() { rest_.report(&out_); }
  /// Whether it failed so often that the cycle is left out; asked once a cycle.
  bool isFrozen() { return backoff_.holds(isTouched()); }
  /// Whether it failed that often at all, and of what.
  bool isFailing() const { return backoff_.fails(); }
  solver::SolveStatus failure() const { return backoff_.status(); }
  /// The cycle is left out for it; `why`: its own failure, or another member's.
  void stayFrozen(solver::SolveStatus why);
  /// It is solved.
  void beginTogether() { rest_.begin(body_.x); }
  /// Whether it came to rest for its part in a cycle of the group that did `together`.
  bool isStill(const TissueStep& together) const {
    return rest_.isStill(body_.x, body_.tool_contact, together);
  }
  /// Its forces at body.x, into `out`; its tolerance is of them from now on. `gradient`: of the
  /// potential, 3 x n [N]; `others`: what they exert on it.
  void takeForces(const Points& gradient, const InteractionForce& others, TissueStep* out);
  /// Whether a tool may touch it in this cycle.
  bool isTouched() const { return body_.tool_contact.possibleByTools(); }
  /// Asked once after a cycle that was solved, of a body that is touched by no tool, nor through
  /// others: whether it would stay folded, for it came to rest so, or trembles inside out in one
  /// cycle after the other, each of which counts as a failure as long as they lead nowhere. What
  /// does so again once it was put back is pressed so, by its load or by another organ: it stays,
  /// and if it trembles it is frozen.
  bool shouldReset(const TissueStep& cycle, bool at_rest);
  /// A tool was near it, or near another member.
  void reached() { was_inverted_ = false; }
  /// It, or another member, does: it is where it was settled, at rest, and moved with its supports.
  void resetWithGroup(const TissueStep& together, solver::SolveStatus why);
  /// The cycle ended at body.x, and the group `at_rest`; `gradient`, `others`: likewise.
  void endTogether(const TissueStep& together, bool at_rest, const Points& gradient,
                   const InteractionForce& others);
  /// Whether a cycle that failed with `status` is a trial after which no other one would do better.
  bool failsForGood(solver::SolveStatus status) const {
    return status != solver::SolveStatus::kDeadline && backoff_.isForGood();
  }
  /// It failed, and all of its group `for_good`.
  void failTogether(const TissueStep& together, bool for_good);
  /// The group's work is reported with this member's.
  void addWork(const TissueStep& together);

 private:
  void put(const Points& positions, const Points& velocities);
  bool cameToRest();
  bool isCrushed();
  bool isStuck(const TissueStep& cycle);
  double wayOfShape() const;
  bool isOutsideOfLaw() const;
  solver::SolveStatus failureHere() const;
  void resetToEquilibrium(solver::SolveStatus why);
  void fallAsleep();
  void fail();
  void stop();
  void takeFigures(const TissueStep& together);
  void reportSolved();
  void reportState();

  static constexpr double kNotStuck = 1.0;

  std::shared_ptr<const fem::EnergyTerm> own_load_;
  FemBody body_;
  std::unique_ptr<StepMethod> method_;
  Rest rest_;
  FailureBackoff backoff_;
  bool stuck_ = false;           // in this cycle
  double stuck_at_ = kNotStuck;  // least det F as it began to be
  bool was_inverted_ = false;    // and put back, since it was at rest otherwise or a tool was near
  Points equilibrium_;
  double contact_force_ = 0.0, support_force_ = 0.0;  // the body's as the cycle began
  bool own_method_, own_start_;
  std::vector<std::string> own_notes_;
  TissueStep out_;
};

/// As makeFemTissue().
std::unique_ptr<FemOrgan> makeFemOrgan(const mesh::TetMesh& mesh,
                                       const fem::Composition& composition,
                                       const Surroundings& surroundings,
                                       const FemSettings& settings, ThreadPool* pool,
                                       const OwnParts& own = {});

}  // namespace palpate::tissue
