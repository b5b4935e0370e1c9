// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::haptics {

/// Local contact model: first-order, unilateral wrench near the pose of the last solve, for rates
/// above that of the simulation. Has no pointers.
struct ContactModel {
  Vec3 p_W = Vec3::Zero();          ///< Origin of the control frame in the last solve, world [m].
  Wrench wrench;                    ///< Wrench at p_W about p_W, world [N], [N m].
  Mat3 stiffness_W = Mat3::Zero();  ///< -d force / d p_W [N/m], symmetric, >= 0.

  double reach = 5.0e-3;  ///< Largest displacement from p_W that changes the force [m].

  /// Wrench for the origin at `p`, world [m], without rotation. The force is linear in the
  /// displacement and never pulls into the tissue; the torque keeps its lever arm.
  Wrench at(const Vec3& p) const;
};

struct LocalModelSettings {
  double max_stiffness = 1.0e5;  ///< Bound of the estimated tissue stiffness [N/m].
  double noise = 2.0e-5;     ///< A displacement of this length [m] halves the weight of an update,
  double force_noise = 0.1;  ///< as does an expected force change of this size [N].
};

/// Estimates the stiffness at a tool from successive solves of any tissue model, by a symmetric
/// secant update along each displacement [Powell 1970]. Reads no clock, allocates nothing.
class LocalModel {
 public:
  explicit LocalModel(const LocalModelSettings& settings = {}) : settings_(settings) {}

  /// Updates the model by a solve with the origin at `p_W`, world [m]. A lost contact is expected
  /// to begin again where it ended while the tool is near. A new contact is at least as stiff as
  /// one that began at the last position.
  const ContactModel& observe(const Vec3& p_W, const Wrench& wrench);
  /// Clears the model: the tool was lost or the scene has changed.
  void forget();
  const ContactModel& model() const { return model_; }

 private:
  Mat3 updated(const Mat3& K, const Vec3& way, const Vec3& push) const;
  void expect(const Vec3& p_W);

  LocalModelSettings settings_;
  ContactModel model_;
  bool known_ = false;          // whether p_last_ is of a solve
  bool expected_ = false;       // whether the model is of an expected contact
  double doubt_ = 0.0;          // depth by which an expected contact was shifted [m]
  Vec3 p_last_ = Vec3::Zero();  // of the last solve [m]
};

}  // namespace palpate::haptics
