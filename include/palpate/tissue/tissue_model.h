// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/obstacle.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/solver/interrupt.h"
#include "palpate/tissue/figures.h"
#include "palpate/tissue/state.h"

namespace palpate::tissue {

/// A contact of a surface sample at the end of a cycle.
struct TissueContact {
  contact::Owner owner;  ///< Owner of the obstacle.
  double penetration;    ///< Penetration [m]; negative where teeth hold the sample at a distance.
  Vec3 p_W;              ///< Position of the sample, world [m].
  Vec3 force_W;          ///< Force on the obstacle, world [N].
  int organ = 0;         ///< Index among the model's organs.
};

/// Result of a cycle. Forces act on the tissue, summed over its nodes, world [N].
struct TissueStep : StepFigures {
  std::vector<TissueContact> contacts;
  Vec3 support_force = Vec3::Zero();
  Vec3 gravity_force = Vec3::Zero();
  Vec3 inertia_force = Vec3::Zero();      ///< Inertia and mass-proportional damping [N].
  Vec3 interaction_force = Vec3::Zero();  ///< Forces of other organs [N].
  // Counters of skipped work, see skips.h.
  int far_bodies = 0;        ///< Obstacles that could not touch in this cycle.
  bool slept = false;        ///< Whether the organ slept: at rest and untouched, nothing solved.
  bool satisfied = false;    ///< Whether the predictor was within tolerance, without an iteration.
  int sleeping_islands = 0;  ///< Islands that slept.
  int distant_samples = 0;   ///< Pairs of sample and near obstacle out of reach.
  int inactive_samples = 0;  ///< Pairs within reach without a touch at the end.
  int frictionless_touches = 0;  ///< Contacts without friction, not evaluated.
  int inviscid_solids = 0;       ///< Solids without viscous terms in a solved cycle.
  int kept_stiffnesses = 0;      ///< Elastic stiffnesses that were reused.
  int still_points = 0;          ///< Points outside the moving region of model mass_spring.
  int apart_organs = 0;          ///< Pairs of bodies that could not interact, each counted once.

  /// Resets all members, but keeps the capacity of `contacts`.
  void clear() {
    std::vector<TissueContact> memory = std::move(contacts);
    memory.clear();
    *this = TissueStep();
    contacts = std::move(memory);
  }
};

/// Present surface of an organ. References are valid until its model steps, is reset or restored.
struct SurfaceState {
  const Points& positions;            ///< World, 3 x n [m]; always finite.
  const Points& velocities;           ///< World, 3 x n [m/s].
  const Eigen::Matrix3Xi& triangles;  ///< Surface, outward: indices into `positions`.
  /// Grows whenever triangles or the number of points change; caches compare it. Points that no
  /// triangle uses are interior.
  std::uint64_t revision;
};

/// How meshes that adapt follow a live host. Replays keep the defaults, so that their results do
/// not depend on the host.
struct MeshPace {
  /// Use a mesh once it is made, instead of a fixed simulated time after its request.
  bool when_ready = false;
  double coarsening = 1.0;  ///< Factor of AdaptSettings::finest, >= 1 [-].
};

/// Interface of tissue models: one or more organs that are solved together and touched by tools.
/// To add one: docs/adding_a_model.md.
class TissueModel {
 public:
  virtual ~TissueModel() = default;

  virtual int numOrgans() const { return 1; }
  virtual SurfaceState surfaceState(int organ) const = 0;
  /// Rest configuration of the points of surfaceState(), world [m], and the cells, for result
  /// files. A model without cells has none. Computed in each call.
  virtual mesh::CellMesh cells(int organ) const = 0;
  const Points& positions(int organ = 0) const { return surfaceState(organ).positions; }
  const Points& velocities(int organ = 0) const { return surfaceState(organ).velocities; }

  /// Simulates one cycle of `dt` [s]; never throws. After a failed solve, reported as status,
  /// positions() are the last good ones and contacts are empty. Figures of several organs are
  /// merged by stepFigures().
  /// @pre `obstacles` have the same shapes in the same order in every cycle.
  virtual const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) = 0;
  /// Results of the last step() of each organ; null where the model does not separate them.
  virtual const std::vector<TissueStep>* reports() const { return nullptr; }

  /// Methods that solve an organ, without repetition, that of the largest island first: names of
  /// methodFacts(), never "auto". Empty for a model without methods.
  virtual std::vector<std::string> methods(int /*organ*/) const { return {}; }

  /// Decisions at construction that concern the user, a line each.
  virtual std::vector<std::string> notes() const { return {}; }

  /// Sets a predicate that every step polls. Where it is true, the step ends with the best state
  /// and status kDeadline. Null, the default: none, so results are reproducible.
  virtual void setInterrupt(const solver::Interrupt* interrupt) = 0;

  /// Sets the pace of adaptive meshes from the next request on. Models without them ignore it.
  virtual void setMeshPace(const MeshPace& /*pace*/) {}

  /// Returns to the initial equilibrium, at rest.
  virtual void reset() = 0;
  /// Sets positions [m] and velocities [m/s] of an organ, 3 x n, and clears all other state.
  /// @pre Sizes are those of positions(organ); all values are finite.
  virtual void setPositions(int organ, const Points& positions, const Points& velocities) = 0;

  /// Returns the whole state, without changing it.
  virtual State state() const = 0;
  /// Sets the state of a state() call; later results are bitwise equal to those of that model.
  /// @throws std::invalid_argument for a state of another kind or truncated bytes; the model must
  /// then be reset or restored.
  virtual void restore(const State& state) = 0;
};

}  // namespace palpate::tissue
