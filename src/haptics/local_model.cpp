// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/local_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace palpate::haptics {
namespace {

constexpr double kShortestTouch = 1.0e-4;  // [m]
constexpr double kLeastIn = 0.3;           // least normal part of a displacement into contact [-]

// Distances at which a contact is expected again [m]: along the normal, across; then the least and
// the largest shift where it did not come, doubled each time.
constexpr double kAway = 0.05, kAcross = 0.005, kDoubt = 1.0e-4, kMostDoubt = 2.0e-3;
// Least factor of the normal stiffness in one update [-]; contacts end faster than stiffnesses
// change.
constexpr double kLoosen = 0.5;
// Depth of the expected contact's reference point [m], where its force is positive.
constexpr double kSkin = 1.0e-6;

// Nearest symmetric matrix with eigenvalues in [0, most].
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
  there.force = wrench.force - stiffness_W * (length > reach ? reach / length : 1.0) * way;
  const double along = there.force.dot(wrench.force);
  if (along <= 0.0) return {};  // no contact
  // The torque is a lever arm times the force, plus a couple.
  const Vec3 arm = wrench.force.cross(wrench.torque) / f2;
  const double couple = wrench.force.dot(wrench.torque) / f2;
  there.torque = arm.cross(there.force) + couple * (along / f2) * wrench.force;
  return there;
}

// Least symmetric change of K towards the secant condition K way = `push`, weighted by the length
// of `way`.
Mat3 LocalModel::updated(const Mat3& K, const Vec3& way, const Vec3& push) const {
  const double noise = std::min(settings_.noise, settings_.force_noise / (K.norm() + 1.0));
  const double weight = way.squaredNorm() + noise * noise;
  const Vec3 missed = push - K * way;
  return K + (missed * way.transpose() + way * missed.transpose()) / weight -
         missed.dot(way) / (weight * weight) * way * way.transpose();
}

// Without contact: expects the last one again at the plane where it ended.
void LocalModel::expect(const Vec3& p_W) {
  const double force = model_.wrench.force.norm();
  if (force == 0.0) return;
  const Vec3 normal = model_.wrench.force / force;
  const double K = normal.dot(model_.stiffness_W * normal);
  const Vec3 from = p_W - (model_.p_W + (K > 0.0 ? force / K : 0.0) * normal);
  const double above = from.dot(normal);
  const double deeper = above > 0.0 ? 0.0 : std::max(kDoubt, doubt_) - above;
  doubt_ += deeper;
  if (K <= 0.0 || doubt_ > kMostDoubt || above > kAway ||
      (from - above * normal).norm() > kAcross) {
    model_ = {};
    expected_ = false;
    return;
  }
  const Vec3 arm = model_.wrench.force.cross(model_.wrench.torque) / (force * force);
  const Vec3 plane = p_W - from - deeper * normal;
  model_.p_W = plane - kSkin * normal;
  model_.wrench.force = K * kSkin * normal;
  model_.wrench.torque = arm.cross(model_.wrench.force);
  model_.stiffness_W = K * normal * normal.transpose();
  expected_ = true;
}

const ContactModel& LocalModel::observe(const Vec3& p_W, const Wrench& wrench) {
  const double force = wrench.force.norm();
  if (force == 0.0) {
    expect(p_W);
  } else {
    if (expected_) {
      // The begin of contact is known to 0.1 mm only, so the stiffness before is kept.
      const Vec3 normal = wrench.force / force;
      model_.stiffness_W = model_.stiffness_W.trace() * normal * normal.transpose();
    } else if (model_.wrench.force != Vec3::Zero()) {
      const Vec3 push = model_.wrench.force - wrench.force;
      Mat3 K = updated(model_.stiffness_W, p_W - model_.p_W, push);
      const Vec3 normal = wrench.force / force;
      const double before = normal.dot(model_.stiffness_W * normal);
      const double lacking = kLoosen * before - normal.dot(K * normal);
      K += std::max(0.0, lacking) * normal * normal.transpose();
      model_.stiffness_W = limited(K, settings_.max_stiffness);
    } else if (known_) {
      // The contact began on this displacement.
      const Vec3 normal = wrench.force / force;
      const Vec3 way = p_W - p_last_;
      const double in = std::max({-way.dot(normal), kLeastIn * way.norm(), kShortestTouch});
      model_.stiffness_W =
          std::min(force / in, settings_.max_stiffness) * normal * normal.transpose();
    }
    model_.p_W = p_W;
    model_.wrench = wrench;
    doubt_ = 0.0;
    expected_ = false;
  }
  p_last_ = p_W;
  known_ = true;
  return model_;
}

void LocalModel::forget() {
  model_ = {};
  known_ = expected_ = false;
  doubt_ = 0.0;
}

}  // namespace palpate::haptics
