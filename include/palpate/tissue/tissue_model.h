// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/instrument/geometry.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/interrupt.h"
#include "palpate/tissue/figures.h"

namespace palpate::tissue {

/// A collision shape on its way through one cycle.
struct ToolBody {
  const instrument::Geometry* geometry;
  int instrument;
  Pose X_WG_begin, X_WG_end;
};

/// A touching point at the end of a cycle.
struct TissueContact {
  int instrument;
  double penetration;  ///< [m]
  Vec3 p_W;            ///< Of the tissue surface [m].
  Vec3 force_W;        ///< On the tool [N].
};

/// What a cycle did. Forces are those on the tissue, summed over its nodes, in world [N].
struct TissueStep : StepFigures {
  std::vector<TissueContact> contacts;
  Vec3 support_force = Vec3::Zero();
  Vec3 gravity_force = Vec3::Zero();
  Vec3 inertia_force = Vec3::Zero();  ///< Of inertia and of damping by mass.
  // What was left out, see skips.h.
  int far_bodies = 0;        ///< Bodies that could not touch in this cycle.
  bool slept = false;        ///< At rest and untouched: nothing was solved.
  bool satisfied = false;    ///< The predictor was within tolerance: no iteration was needed.
  int sleeping_islands = 0;  ///< Parts that slept, of a body that consists of several.
  int distant_samples = 0;   ///< Surface points, times near bodies, that were out of reach.
  int inactive_samples = 0;  ///< Those within reach that did not touch at the end.
  int inviscid_solids = 0;   ///< Without viscous terms, in a cycle that was solved.
  int kept_stiffnesses = 0;  ///< Elastic stiffnesses that were not assembled again.

  /// As new, but with its memory.
  void clear() {
    std::vector<TissueContact> memory = std::move(contacts);
    memory.clear();
    *this = TissueStep();
    contacts = std::move(memory);
  }
};

/// A soft body that tools press. The simulation sees only this; behind it stands a mechanical
/// model.
class TissueModel {
 public:
  virtual ~TissueModel() = default;

  virtual const mesh::TetMesh& restMesh() const = 0;  ///< World [m].
  virtual const Points& positions() const = 0;        ///< World, 3 x n [m]; always finite.
  virtual const Points& velocities() const = 0;       ///< World, 3 x n [m/s].
  virtual const Eigen::Matrix3Xi& surfaceTriangles() const = 0;  ///< Outward, into positions().

  /// One cycle of `dt` [s]. Never throws. A solve that fails is a status: positions() then are the
  /// last good ones, and the contacts are empty.
  virtual const TissueStep& step(const std::vector<ToolBody>& bodies, double dt) = 0;

  /// By which methods it is solved, once each, that of its largest part first: names of
  /// methodFacts(), "auto" never among them. Empty for a model that has no such choice.
  virtual std::vector<std::string> methods() const { return {}; }

  /// What was decided when the model was made and the user should know, a line each.
  virtual std::vector<std::string> notes() const { return {}; }

  /// Asked now and then in every step; when it says true, the step ends with the best state so far
  /// and the status kDeadline. Null, as at first: nobody is asked, and steps can be repeated.
  virtual void setInterrupt(const solver::Interrupt* interrupt) = 0;

  /// Back to the initial equilibrium, at rest.
  virtual void reset() = 0;
  /// Sizes as positions(), all finite: the caller's duty.
  virtual void restore(const Points& positions, const Points& velocities) = 0;
};

}  // namespace palpate::tissue
