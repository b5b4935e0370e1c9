// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/state_bytes.h"
#include "palpate/tissue/tissue_model.h"
#include "tool_contact.h"

namespace palpate::tissue {

/// When an organ has come to rest, and what is reported of it while it sleeps. A cycle goes
///
///   tool_contact.begin(...); if (rest.sleeps(tool_contact)) return rest.report(&out);
///   rest.begin(x); ... solve ...
///   if (rest.isStill(x, touch, out) && what is unbalanced is within tolerance) rest.fallAsleep();
///   ... report forces ...; rest.remember(out);
class Rest {
 public:
  /// Less than this part of its size in a cycle is no motion; a body that creeps may go far in many
  /// cycles.
  static constexpr double kMotion = 1e-6, kMotionCreeping = 1e-9;

  /// `motion` [m]: what counts as none. `allowed`: false, it never sleeps.
  Rest(double motion, bool allowed) : motion_(motion), allowed_(allowed) {}

  /// Whether the cycle that touch has begun changes nothing.
  bool sleeps(const ToolContact& tool_contact) const {
    return asleep_ && !tool_contact.possibleByTools();
  }
  /// The whole cycle: as the last one that was solved, without its work.
  void report(TissueStep* out) const;

  /// A cycle that is solved, from x, 3 x n [m].
  void begin(const Points& x) {
    x_begin_ = x;
    asleep_ = false;
  }
  /// The longest way of a component since the cycle began, of points that are at x now, beside that
  /// of all of them [m].
  double way(const Points& x, const Vec3& of_all = Vec3::Zero()) const {
    return ((x - x_begin_).colwise() - of_all).cwiseAbs().maxCoeff();
  }
  /// Whether the points, now at x, hardly moved, no tool touches them, no iteration was needed or
  /// they led back, and the cycle was not cut; the anatomy, on which they may lie, does not move.
  bool isStill(const Points& x, const ToolContact& tool_contact, const TissueStep& out) const;
  /// It is still, and would be if it were stopped here.
  void fallAsleep() { asleep_ = true; }
  /// What report() will say, if it came to rest.
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
