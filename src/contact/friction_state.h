// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "palpate/contact/friction.h"
#include "palpate/contact/response.h"
#include "stick_points.h"

namespace palpate::contact {

/// A touch that clings within a step.
struct FrictionState {
  StickPoint stick_point;  ///< Where the step began; what slides or bites as it goes on.
  Vec3 normal_G;           ///< Of the plane that it slides in: unit.
  double limit = 0.0;      ///< Of its friction [N].
  double begin = 0.0;      ///< The normal force where the step began [N].
  double pressing = 0.0;   ///< The normal force that the limit is of [N], >= 0.
};

/// What clings, from step to step and within one; see withFriction() for the formulas.
class FrictionStates {
 public:
  /// `normal` says what presses, and outlives this, as `table` does. `stiffness` [Pa/m].
  FrictionStates(const Response* normal, const FrictionTable* table, double stiffness)
      : normal_(*normal), table_(*table), stiffness_(stiffness) {}

  /// Null: none.
  const FrictionState* find(const Touch& touch) const;
  /// Whether a touch answers that is not pressed.
  bool clings(const Touch& touch) const;
  /// The same of one of these samples.
  bool clings(int number, int first, int last) const;
  double energy(const FrictionState& state, const Touch& touch) const;
  /// Of the spring along the surface [N].
  Vec3 force(const FrictionState& state, const Touch& touch) const;
  /// Of the one away from it [N].
  double tension(const FrictionState& state, const Touch& touch) const;
  Mat3 stiffness(const FrictionState& state, const Touch& touch, fem::Tangent tangent) const;

  // As those of Response.
  void begin(const std::vector<Touch>& touches);
  void end(const std::vector<Touch>& touches);
  bool augmentationConverged(const std::vector<Touch>& touches) { return !review(touches, false); }
  void augment(const std::vector<Touch>& touches) { review(touches, true); }
  void confine(const std::vector<Touch>& touches);
  void goOnFrom(const FrictionStates& old, const std::function<int(int)>& now);
  void forget();
  void save(StateWriter* to) const { stick_points_.save(to); }
  void restore(StateReader* from);

 private:
  Vec3 stretch(const FrictionState& state, const Touch& touch) const;
  double pressing(const Touch& touch) const;
  double allowed(const FrictionState& state, const Touch& touch) const;
  double springOf(const Touch& touch) const;
  FrictionState* findAmong(const Touch& touch);
  void sumPressing(const std::vector<Touch>& touches);
  bool presses(int number) const;
  bool review(const std::vector<Touch>& touches, bool change);
  bool reviewOne(const Touch& touch, bool change, FrictionState* state);
  double relaxed(double N, double before) const;
  bool releases(const Touch& touch, bool change, FrictionState* state) const;

  const Response& normal_;
  const FrictionTable& table_;
  double stiffness_;
  StickPoints stick_points_;            // where the last step ended
  std::vector<FrictionState> states_;   // within a step, sorted by their points
  mutable std::size_t last_found_ = 0;  // of the touch that was asked for last
  std::vector<StickPoint> next_;
  std::vector<std::pair<int, double>> presses_;  // by obstacle, as a whole [N]
  std::size_t iteration_ = 0;                    // of solutions in the step
  double pressing_ = 0.0, excess_ = 0.0;         // of what was reviewed [N]
};

}  // namespace palpate::contact
