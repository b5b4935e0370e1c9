// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/state_bytes.h"
#include "palpate/tissue/tissue_model.h"
#include "tool_contact.h"

namespace palpate::tissue {

/// Sleep of an organ at rest, and its report meanwhile. Protocol of a cycle:
///
///   tool_contact.begin(...); if (rest.sleeps(tool_contact)) return rest.report(&out);
///   rest.begin(x); ... solve ...
///   if (rest.isStill(x, touch, out) && what is unbalanced is within tolerance) rest.fallAsleep();
///   ... report forces ...; rest.remember(out);
class Rest {
 public:
  /// Displacement per cycle that counts as rest, relative to the size [-]; less for viscous bodies,
  /// which creep over many cycles.
  static constexpr double kMotion = 1e-6, kMotionCreeping = 1e-9;

  /// `motion`: displacement per cycle that counts as rest [m]; `allowed`: false disables sleep.
  Rest(double motion, bool allowed) : motion_(motion), allowed_(allowed) {}

  /// Whether the organ sleeps in the cycle that `tool_contact` has begun.
  bool sleeps(const ToolContact& tool_contact) const {
    return asleep_ && !tool_contact.possibleByTools();
  }
  /// Reports the whole cycle as the last solved one, without its work.
  void report(TissueStep* out) const;

  /// Begins a solved cycle at x, 3 x n [m].
  void begin(const Points& x) {
    x_begin_ = x;
    asleep_ = false;
  }
  /// Largest displacement of a component since begin(), relative to the rigid displacement `of_all`
  /// [m].
  double way(const Points& x, const Vec3& of_all = Vec3::Zero()) const {
    return ((x - x_begin_).colwise() - of_all).cwiseAbs().maxCoeff();
  }
  /// Whether the cycle left the points at x in place, or moved them less than the limit without an
  /// iteration. False where a tool may touch or the cycle was cut; the anatomy does not count.
  bool isStill(const Points& x, const ToolContact& tool_contact, const TissueStep& out) const;
  /// Lets the organ sleep from the next cycle on.
  void fallAsleep() { asleep_ = true; }
  /// Stores the result of the cycle for report().
  void remember(const TissueStep& out) { last_ = out; }
  void wake() { asleep_ = false; }

  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  double motion_;
  bool allowed_;
  bool asleep_ = false;
  Points x_begin_;
  TissueStep last_;
};

}  // namespace palpate::tissue
