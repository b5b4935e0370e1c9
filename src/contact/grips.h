// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "anchors.h"
#include "palpate/contact/friction.h"
#include "palpate/contact/response.h"

namespace palpate::contact {

/// A touch that clings within a step.
struct Grip {
  Anchor anchor;          ///< Where the step began; what slides or bites as it goes on.
  Vec3 normal_G;          ///< Of the plane that it slides in: unit.
  double limit = 0.0;     ///< Of its friction [N].
  double begin = 0.0;     ///< The normal force where the step began [N].
  double pressing = 0.0;  ///< The normal force that the limit is of [N], >= 0.
};

/// What clings, from step to step and within one; see withFriction() for the formulas.
class Grips {
 public:
  /// `normal` says what presses, and outlives this, as `table` does. `stiffness` [Pa/m].
  Grips(const Response* normal, const FrictionTable* table, double stiffness)
      : normal_(*normal), table_(*table), stiffness_(stiffness) {}

  /// Null: none.
  const Grip* find(const Touch& touch) const;
  /// Whether a touch answers that is not pressed.
  bool clings(const Touch& touch) const;
  /// The same of one of these samples.
  bool clings(int number, int first, int last) const;
  double energy(const Grip& grip, const Touch& touch) const;
  /// Of the spring along the surface [N].
  Vec3 force(const Grip& grip, const Touch& touch) const;
  /// Of the one away from it [N].
  double tension(const Grip& grip, const Touch& touch) const;
  Mat3 stiffness(const Grip& grip, const Touch& touch, fem::Tangent tangent) const;

  // As those of Response.
  void begin(const std::vector<Touch>& touches);
  void end(const std::vector<Touch>& touches);
  bool settled(const std::vector<Touch>& touches) { return !review(touches, false); }
  void settle(const std::vector<Touch>& touches) { review(touches, true); }
  void confine(const std::vector<Touch>& touches);
  void goOnFrom(const Grips& old, const std::function<int(int)>& now);
  void forget();
  void save(StateWriter* to) const { anchors_.save(to); }
  void restore(StateReader* from);

 private:
  Vec3 stretch(const Grip& grip, const Touch& touch) const;
  double pressing(const Touch& touch) const;
  double allowed(const Grip& grip, const Touch& touch) const;
  double springOf(const Touch& touch) const;
  Grip* findAmong(const Touch& touch);
  void sumPressing(const std::vector<Touch>& touches);
  bool presses(int number) const;
  bool review(const std::vector<Touch>& touches, bool change);
  bool reviewOne(const Touch& touch, bool change, Grip* grip);
  double cautious(double N, double before) const;
  bool letGo(const Touch& touch, bool change, Grip* grip) const;

  const Response& normal_;
  const FrictionTable& table_;
  double stiffness_;
  Anchors anchors_;                // where the last step ended
  std::vector<Grip> grips_;        // within a step, sorted by their anchors
  mutable std::size_t bound_ = 0;  // of the touch that was asked for last
  std::vector<Anchor> next_;
  std::vector<std::pair<int, double>> presses_;  // by obstacle, as a whole [N]
  std::size_t round_ = 0;                        // of solutions in the step
  double pressing_ = 0.0, excess_ = 0.0;         // of what was reviewed [N]
};

}  // namespace palpate::contact
