// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "friction_list.h"
#include "palpate/contact/response.h"
#include "stick_points.h"

namespace palpate::contact {

/// Friction of a touch within a step.
struct FrictionState {
  StickPoint stick_point;  ///< Stick point at the step's begin; `slides` and `hold` change within
                           ///< the step.
  Vec3 normal_G;           ///< Normal of the slip plane, unit, obstacle's frame.
  double limit = 0.0;      ///< Limit of the friction force [N].
  double begin = 0.0;      ///< Normal force at the step's begin [N].
  double pressing = 0.0;   ///< Normal force in the limit [N], >= 0.
};

/// Friction states of all touches, within and between steps; withFriction() has the formulas.
class FrictionStates {
 public:
  /// `normal`: response for normal forces; `stiffness` [Pa/m].
  /// @pre `normal`, `laws` and `table` outlive this.
  FrictionStates(const Response* normal, const FrictionList* laws, const FrictionTable* table,
                 double stiffness)
      : normal_(*normal), laws_(*laws), table_(*table), stiffness_(stiffness) {}

  /// Returns the friction state of a touch; null: none.
  const FrictionState* find(const Touch& touch) const;
  /// Whether a touch without pressure has friction or is held.
  bool clings(const Touch& touch) const;
  /// Whether clings() may be true for a sample in [first, last] of an obstacle.
  bool clings(int number, int first, int last) const;
  double energy(const FrictionState& state, const Touch& touch) const;
  /// Friction force: of the spring in the slip plane [N].
  Vec3 force(const FrictionState& state, const Touch& touch) const;
  /// Tensile force of a held touch along the normal [N].
  double tension(const FrictionState& state, const Touch& touch) const;
  Mat3 stiffness(const FrictionState& state, const Touch& touch, fem::Tangent tangent) const;

  // As in Response.
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
  FrictionLimit limit(const Touch& touch, double normal_force, bool slides) const;
  double holding(const Touch& touch) const;
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
  const FrictionList& laws_;
  const FrictionTable& table_;
  double stiffness_;
  StickPoints stick_points_;            // at the end of the last step
  std::vector<FrictionState> states_;   // within a step, sorted by obstacle and sample
  mutable std::size_t last_found_ = 0;  // index of the last find()
  std::vector<StickPoint> next_;
  std::vector<std::pair<int, double>> presses_;  // total normal force, by obstacle [N]
  std::size_t iteration_ = 0;                    // augmentations in the step
  double pressing_ = 0.0, excess_ = 0.0;         // sums over the reviewed touches [N]
};

}  // namespace palpate::contact
