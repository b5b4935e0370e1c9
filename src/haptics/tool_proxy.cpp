// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/tool_proxy.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "limits.h"

namespace palpate::haptics {
namespace {

constexpr double kFastest = 1e6;  // bound of restored velocities [m/s], [rad/s]

// Changes `velocity` towards way / dt within the acceleration, and so that the tool can stop at the
// end. Returns whether it reaches the end in this cycle.
bool accelerate(const Vec3& way, double dt, double max_speed, double max_acceleration,
                Vec3* velocity) {
  const Vec3 wanted = way / dt;
  // The stopping distance in cycles of dt is v^2 / (2 a) + v dt / 2.
  const double change_in_cycle = max_acceleration * dt;
  const double stops =
      std::sqrt(0.25 * change_in_cycle * change_in_cycle + 2.0 * max_acceleration * way.norm()) -
      0.5 * change_in_cycle;
  const double speed = std::min(max_speed, stops);
  const Vec3 change = clamped(wanted, speed) - *velocity;
  *velocity += clamped(change, change_in_cycle);
  return wanted.norm() <= speed && change.norm() <= change_in_cycle;
}

Vec3 turnBetween(const Mat3& from, const Mat3& to) {
  const Eigen::AngleAxisd turn(Mat3(to * from.transpose()));
  return turn.angle() * turn.axis();
}

Mat3 turned(const Mat3& R, const Vec3& turn) {
  const double angle = turn.norm();
  if (angle == 0.0) return R;
  const Mat3 R_new = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * R;
  return Eigen::Quaterniond(R_new).normalized().toRotationMatrix();
}

}  // namespace

ToolProxy::ToolProxy(const ProxySettings& settings, std::size_t control_link,
                     std::vector<std::size_t> links)
    : settings_(settings), control_(control_link), links_(std::move(links)) {
  requirePositive("ToolProxy", "max_speed", settings.max_speed);
  requirePositive("ToolProxy", "max_acceleration", settings.max_acceleration);
  requirePositive("ToolProxy", "max_angular_speed", settings.max_angular_speed);
  requirePositive("ToolProxy", "max_angular_acceleration", settings.max_angular_acceleration);
}

bool ToolProxy::follow(const LinkPoses& commanded, double dt, const Free& is_free) {
  if (there()) {
    approach(commanded, dt);
    return true;
  }
  waiting_ = !is_free(commanded);
  if (!waiting_) startAt(commanded);
  return there();
}

void ToolProxy::leave() {
  poses_.clear();
  waiting_ = false;
}

void ToolProxy::startAt(const LinkPoses& poses) {
  poses_ = poses;
  velocity_.setZero();
  angular_velocity_.setZero();
  waiting_ = false;
}

// Moves the control frame within the limits, then the other links relative to it.
void ToolProxy::approach(const LinkPoses& commanded, double dt) {
  const Pose X_WP = poses_[control_], &X_WC = commanded[control_];
  const bool reaches = accelerate(X_WC.translation() - X_WP.translation(), dt, settings_.max_speed,
                                  settings_.max_acceleration, &velocity_);
  const bool turns =
      accelerate(turnBetween(X_WP.linear(), X_WC.linear()), dt, settings_.max_angular_speed,
                 settings_.max_angular_acceleration, &angular_velocity_);
  Pose X_new = X_WC;
  if (!reaches) X_new.translation() = X_WP.translation() + dt * velocity_;
  if (!turns) X_new.linear() = turned(X_WP.linear(), dt * angular_velocity_);

  bool all = reaches && turns;
  next_ = commanded;
  const Pose X_NC = X_new * X_WC.inverse();
  for (Pose& X : next_) X = X_NC * X;
  for (const std::size_t l : links_) {
    const Pose from = X_WP.inverse() * poses_[l], to = X_WC.inverse() * commanded[l];
    const Vec3 way = to.translation() - from.translation();
    const Vec3 turn = turnBetween(from.linear(), to.linear());
    const Vec3 shift = clamped(way, settings_.max_speed * dt);
    const Vec3 part = clamped(turn, settings_.max_angular_speed * dt);
    if (shift == way && part == turn) continue;
    Pose relative = Pose::Identity();
    relative.translation() = from.translation() + shift;
    relative.linear() = turned(from.linear(), part);
    next_[l] = X_new * relative;
    all = false;
  }
  poses_ = all ? commanded : next_;
}

void ToolProxy::save(StateWriter* out) const {
  out->put(static_cast<std::int64_t>(poses_.size()));
  for (const Pose& X : poses_) out->put(X.matrix());
  out->put(velocity_);
  out->put(angular_velocity_);
  out->put(waiting_);
}

void ToolProxy::restore(StateReader* in) {
  constexpr auto kBytes = static_cast<std::int64_t>(sizeof(Pose));
  poses_.resize(static_cast<std::size_t>(in->count(kBytes)));
  for (Pose& X : poses_) in->get(&X.matrix());
  in->get(&velocity_);
  in->get(&angular_velocity_);
  in->get(&waiting_);
  const auto sensible = [](const Vec3& v) { return v.norm() <= kFastest; };
  if (!sensible(velocity_) || !sensible(angular_velocity_)) StateReader::fail();
}

}  // namespace palpate::haptics
