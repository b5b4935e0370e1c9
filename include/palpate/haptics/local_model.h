// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::haptics {

/// What a tool feels near the pose of the last solve, to first order and one-sided: for who asks
/// more often than the simulation can answer. Plain numbers.
struct ContactModel {
  Vec3 p_W = Vec3::Zero();          ///< Control frame's origin for which it was solved [m].
  Wrench wrench;                    ///< There, about that origin, in world.
  Mat3 stiffness_W = Mat3::Zero();  ///< -d force / d p_W [N/m], symmetric, >= 0.

  double reach = 5.0e-3;  ///< [m] motions beyond it change the force no further.

  /// The wrench with the origin at `p` [m], the tool not turned: the force follows the stiffness
  /// and never draws the tool into the tissue, the torque keeps its arm.
  Wrench at(const Vec3& p) const;
};

struct LocalModelSettings {
  double max_stiffness = 1.0e5;  ///< Of the tissue [N/m].
  double noise = 2.0e-5;         ///< A motion of this [m] tells half of what a long one does,
  double force_noise = 0.1;      ///< or one that should change the force by this [N].
};

/// Learns the stiffness that a tool feels from the solves themselves, whatever model of tissue made
/// them: by a symmetric secant update along each motion [Powell 1970].
/// It costs the simulation nothing. No clock, no allocation.
class LocalModel {
 public:
  explicit LocalModel(const LocalModelSettings& settings = {}) : settings_(settings) {}

  /// A solve with the control frame's origin at `p_W` [m] gave this wrench. A contact that was lost
  /// is expected to begin again where it ended, while the tool is near and nothing speaks against
  /// it; another is at least as stiff as if it had begun where the tool was.
  const ContactModel& observe(const Vec3& p_W, const Wrench& wrench);
  /// The tool was lost, or the scene is another one.
  void forget();
  const ContactModel& model() const { return model_; }

 private:
  Mat3 updated(const Mat3& K, const Vec3& way, const Vec3& push) const;
  void expect(const Vec3& p_W);

  LocalModelSettings settings_;
  ContactModel model_;
  bool known_ = false;          // there is a last solve to compare with
  bool expected_ = false;       // the model is of a contact that may come again
  double doubt_ = 0.0;          // how much deeper a contact is expected when it did not come [m]
  Vec3 p_last_ = Vec3::Zero();  // of the last solve [m]
};

}  // namespace palpate::haptics
