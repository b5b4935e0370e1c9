// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "inside_tools.h"
#include "needles.h"
#include "palpate/contact/contact_potential.h"
#include "palpate/tissue/model_settings.h"
#include "palpate/tissue/tissue_model.h"
#include "tool_path.h"

namespace palpate::tissue {

/// The surface of an organ, as tools touch it: its contact potential, the tools' way through a
/// cycle, and what is reported of both. For models of any kind whose points carry forces.
class ToolContact {
 public:
  /// `X`: points at rest, 3 x n [m]; `triangles`: their surface, outward. `organ`: the model's,
  /// named in contacts. `excess(r)`: by which part a force is too large where edges are r times the
  /// obstacle's inscribed radius; empty: nobody knows.
  /// `tets`: between the points, for needles; without columns none gets in.
  /// `thickness` [m]: of a sheet of which the triangles are the middle; 0: they enclose a body. A
  /// sheet has no inside: tools touch either side, by its samples alone, and none is let be.
  /// `samples`: where contact is felt; without any, samples of the triangles, which thin tools
  /// meet, too.
  ToolContact(const Points& X, const Eigen::Matrix3Xi& triangles, const ModelSettings& settings,
              int organ = 0, std::function<double(double r)> excess = {},
              const Eigen::Matrix4Xi& tets = {}, double thickness = 0.0,
              const std::vector<contact::SurfaceSample>& samples = {});
  ToolContact(const ToolContact&) = delete;  // the tool path refers to the contact
  ToolContact& operator=(const ToolContact&) = delete;

  /// Begins a cycle of `dt` [s] with the points at x going with v, 3 x n: which tools can touch,
  /// and which points. The tools are placed where they end.
  void begin(const std::vector<contact::Obstacle>& obstacles, const Points& x, const Points& v,
             double dt, TissueStep* out);
  /// Whether anything may touch in this cycle.
  bool possible() const { return contact.hasCandidates() || !needles.inside().empty(); }
  /// Whether an instrument may touch, whose motion an organ at rest would feel.
  bool possibleByTools() const;
  /// Brings tools to part s of their ways.
  void moveTo(double s);
  /// A step has ended at x.
  void endStep(const Points& x);
  /// All memory from one cycle to the next, and within one.
  void save(StateWriter* to) const;
  void restore(StateReader* from);
  void forget();
  /// Takes over what `old` remembers, of the same body on another mesh: X and old_X are the points
  /// of both at rest.
  void goOnFrom(const ToolContact& old, const Points& X, const Points& old_X);
  /// Adds the contacts at x, where the cycle ends, and what of their forces is due to the mesh.
  /// Returns the norm of their nodal forces [N].
  double report(const Points& x, TissueStep* out);
  /// After that: the points within reach that did not touch.
  void countInactive(TissueStep* out) const;

  contact::ContactPotential contact;
  ToolPath tool_path;
  InsideTools inside_tools;
  Needles needles;

 private:
  const Eigen::Matrix3Xi triangles_;
  bool has_inside_;
  int organ_;
  std::function<double(double)> excess_;
  std::vector<Vec3> too_much_;  // by instrument [N]
  bool skip_inactive_;
  std::vector<contact::Contact> contacts_;
  Points nodal_;
};

}  // namespace palpate::tissue
