// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/local_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace palpate::haptics {
namespace {

constexpr double kShortestTouch = 1.0e-4;  // [m]

// The nearest symmetric matrix with eigenvalues in [0, most].
Mat3 limited(const Mat3& K, double most) {
  const Mat3 symmetric = 0.5 * (K + K.transpose());
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(symmetric);
  const Vec3 values = eigen.eigenvalues().cwiseMax(0.0).cwiseMin(most);
  if (values == eigen.eigenvalues()) return symmetric;
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

Wrench ContactModel::at(const Vec3& p) const {
  const double f2 = wrench.force.squaredNorm();
  if (f2 == 0.0) return wrench;
  Wrench there;
  const Vec3 way = p - p_W;
  const double length = way.norm();
  there.force = wrench.force - stiffness_W * (length > kReach ? kReach / length : 1.0) * way;
  const double along = there.force.dot(wrench.force);
  if (along <= 0.0) return {};  // it let go
  // The torque is that of the force at an arm, and a couple about it.
  const Vec3 arm = wrench.force.cross(wrench.torque) / f2;
  const double couple = wrench.force.dot(wrench.torque) / f2;
  there.torque = arm.cross(there.force) + couple * (along / f2) * wrench.force;
  return there;
}

// The smallest symmetric change of K after which it explains as much of `push` = K way as a way so
// long tells.
Mat3 LocalModel::updated(const Mat3& K, const Vec3& way, const Vec3& push) const {
  const double weight = way.squaredNorm() + settings_.noise * settings_.noise;
  const Vec3 missed = push - K * way;
  return K + (missed * way.transpose() + way * missed.transpose()) / weight -
         missed.dot(way) / (weight * weight) * way * way.transpose();
}

const ContactModel& LocalModel::observe(const Vec3& p_W, const Wrench& wrench) {
  const Vec3 way = p_W - model_.p_W;
  const double force = wrench.force.norm();
  if (force == 0.0) {
    model_.stiffness_W.setZero();
  } else if (model_.wrench.force != Vec3::Zero()) {
    const Vec3 push = model_.wrench.force - wrench.force;
    model_.stiffness_W = limited(updated(model_.stiffness_W, way, push), settings_.max_stiffness);
  } else if (known_) {
    // It came from nothing on this way, or a part of it.
    const Vec3 normal = wrench.force / force;
    const double in = std::max(-way.dot(normal), kShortestTouch);
    model_.stiffness_W =
        std::min(force / in, settings_.max_stiffness) * normal * normal.transpose();
  }
  model_.p_W = p_W;
  model_.wrench = wrench;
  known_ = true;
  return model_;
}

void LocalModel::forget() {
  model_ = {};
  known_ = false;
}

}  // namespace palpate::haptics
