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

/// A touching point at the end of a cycle.
struct TissueContact {
  contact::Owner owner;  ///< Of the obstacle.
  double penetration;    ///< [m]; negative where it is held at a distance.
  Vec3 p_W;              ///< Of the tissue surface [m].
  Vec3 force_W;          ///< On the obstacle [N].
  int organ = 0;         ///< Of the model's.
};

/// What a cycle did. Forces are those on the tissue, summed over its nodes, in world [N].
struct TissueStep : StepFigures {
  std::vector<TissueContact> contacts;
  Vec3 support_force = Vec3::Zero();
  Vec3 gravity_force = Vec3::Zero();
  Vec3 inertia_force = Vec3::Zero();      ///< Of inertia and of damping by mass.
  Vec3 interaction_force = Vec3::Zero();  ///< Of other organs.
  // What was left out, see skips.h.
  int far_bodies = 0;            ///< Bodies that could not touch in this cycle.
  bool slept = false;            ///< At rest and untouched: nothing was solved.
  bool satisfied = false;        ///< The predictor was within tolerance: no iteration was needed.
  int sleeping_islands = 0;      ///< Parts that slept, of a body that consists of several.
  int distant_samples = 0;       ///< Surface points, times near bodies, that were out of reach.
  int inactive_samples = 0;      ///< Those within reach that did not touch at the end.
  int frictionless_touches = 0;  ///< Contacts whose friction was not evaluated: they have none.
  int inviscid_solids = 0;       ///< Without viscous terms, in a cycle that was solved.
  int kept_stiffnesses = 0;      ///< Elastic stiffnesses that were not assembled again.
  int still_points = 0;          ///< Outside of the region that moves; of model mass_spring.
  int apart_organs =
      0;  ///< Others that one of its bodies could not act on, each pair counted once.

  /// As new, but with its memory.
  void clear() {
    std::vector<TissueContact> memory = std::move(contacts);
    memory.clear();
    *this = TissueStep();
    contacts = std::move(memory);
  }
};

/// What there is of an organ now. The references hold until its model steps, is reset or restored.
struct SurfaceState {
  const Points& positions;            ///< World, 3 x n [m]; always finite.
  const Points& velocities;           ///< World, 3 x n [m/s].
  const Eigen::Matrix3Xi& triangles;  ///< Its surface, outward, into positions.
  /// Grows whenever the triangles or the number of points become others, and never shrinks:
  /// whoever keeps something about them looks here. Points that no triangle uses are inside.
  std::uint64_t revision;
};

/// One or more soft organs that tools press, solved together. The simulation sees only this; behind
/// it stands a mechanical model. To add one: docs/adding_a_model.md.
class TissueModel {
 public:
  virtual ~TissueModel() = default;

  virtual int numOrgans() const { return 1; }
  virtual SurfaceState surfaceState(int organ) const = 0;
  /// The points of surfaceState() at rest in the world, and what lies between them, for files of
  /// results. A model without cells leaves these out. Made anew in each call.
  virtual mesh::CellMesh cells(int organ) const = 0;
  const Points& positions(int organ = 0) const { return surfaceState(organ).positions; }
  const Points& velocities(int organ = 0) const { return surfaceState(organ).velocities; }

  /// One cycle of `dt` [s]. Never throws. A solve that fails is a status: positions() then are the
  /// last good ones, and the contacts are empty. `obstacles` are the same shapes in the same order
  /// in every cycle. Figures of several organs are sums, or the worst of them.
  virtual const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) = 0;
  /// What the last step() did organ by organ, of a model that can tell that of several; else null.
  virtual const std::vector<TissueStep>* reports() const { return nullptr; }

  /// By which methods an organ is solved, once each, that of its largest part first: names of
  /// methodFacts(), "auto" never among them. Empty for a model that has no such choice.
  virtual std::vector<std::string> methods(int /*organ*/) const { return {}; }

  /// What was decided when the model was made and the user should know, a line each.
  virtual std::vector<std::string> notes() const { return {}; }

  /// Asked now and then in every step; when it says true, the step ends with the best state so far
  /// and the status kDeadline. Null, as at first: nobody is asked, and steps can be repeated.
  virtual void setInterrupt(const solver::Interrupt* interrupt) = 0;

  /// Back to the initial equilibrium, at rest.
  virtual void reset() = 0;
  /// Goes on from there without a past. Sizes as positions(organ), all finite: the caller's duty.
  virtual void setPositions(int organ, const Points& positions, const Points& velocities) = 0;

  /// All memory. To take it changes nothing.
  virtual State state() const = 0;
  /// Goes on as the model would have of which this is the state(), to the bit.
  /// @throws std::invalid_argument for a state of another kind, or bytes that are cut off; the
  /// model must then be reset or restored before it goes on.
  virtual void restore(const State& state) = 0;
};

}  // namespace palpate::tissue
