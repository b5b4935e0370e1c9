// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "inside_tools.h"
#include "needles.h"
#include "palpate/contact/contact_potential.h"
#include "palpate/tissue/model_settings.h"
#include "palpate/tissue/step_hooks.h"
#include "palpate/tissue/tissue_model.h"
#include "tool_path.h"

namespace palpate::tissue {

/// Contact of an organ's surface with tools: contact potential, tool path, inside tools, needles,
/// and their report. For any model with forces at points.
class ToolContact final : public StepHooks {
 public:
  /// `X`: rest positions, 3 x n [m]; `triangles`: surface, outward; `organ`: index in contacts.
  /// `excess(r)`: relative force excess for edges of r inscribed radii; empty: unknown. `tets`: for
  /// needles; without columns there are none. `thickness`: of a sheet with the triangles in its
  /// middle [m]; 0: they enclose a body. A sheet is touched on both sides, by samples alone, and
  /// has no inside tools. `samples`: default: samples of the triangles, with face contact of thin
  /// tools.
  ToolContact(const Points& X, const Eigen::Matrix3Xi& triangles, const ModelSettings& settings,
              int organ = 0, std::function<double(double r)> excess = {},
              const Eigen::Matrix4Xi& tets = {}, double thickness = 0.0,
              const std::vector<contact::SurfaceSample>& samples = {});
  ToolContact(const ToolContact&) = delete;  // tool_path refers to contact
  ToolContact& operator=(const ToolContact&) = delete;

  /// Begins a cycle of `dt` [s] with positions x [m] and velocities v [m/s], 3 x n: finds near
  /// tools and candidates, and moves the tools to the end of their path.
  void begin(const std::vector<contact::Obstacle>& obstacles, const Points& x, const Points& v,
             double dt, TissueStep* out);
  /// Whether a touch is possible in this cycle.
  bool possible() const { return contact.hasCandidates() || !needles.inside().empty(); }
  /// Whether an instrument may touch in this cycle; the anatomy does not count.
  bool possibleByTools() const;
  /// Moves tools and needles to fraction s of the tool path.
  void moveTo(double s);
  bool holds(const Points& x) const override { return tool_path.candidatesHold(x); }
  void beginStep(const Points& x) override { tool_path.beginStep(x); }
  bool augmentationConverged(const Points& x) override { return contact.augmentationConverged(x); }
  void augment(const Points& x) override { contact.augment(x); }
  void endStep(const Points& x) override;
  void learn(const Points& x, double h) override { contact.learn(x, h); }
  void forget() override;
  /// Writes the state between and within cycles.
  void save(StateWriter* to) const override;
  void restore(StateReader* from) override;
  /// Takes over the state of `old`, of the same body before a mesh adaptation; X and old_X: rest
  /// positions of both, 3 x n [m].
  void goOnFrom(const ToolContact& old, const Points& X, const Points& old_X);
  /// Adds the contacts at x, the end of the cycle, and their estimated mesh error to `out`. Returns
  /// the norm of the nodal contact forces [N].
  double report(const Points& x, TissueStep* out);
  /// Adds the number of inactive candidates to `out`.
  /// @pre report().
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
  std::vector<Vec3> too_much_;  // estimated force excess, by instrument [N]
  bool skip_inactive_;
  std::vector<contact::Contact> contacts_;
  Points nodal_;
};

}  // namespace palpate::tissue
