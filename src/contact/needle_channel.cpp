// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/needle_channel.h"

#include <algorithm>

namespace palpate::contact {
namespace {

// Of the points' spacing: so far before the tip one is free of it.
constexpr double kFree = 0.5;

}  // namespace

void NeedleChannel::setPose(const Vec3& origin, const Vec3& axis) {
  origin_ = origin;
  axis_ = axis;
}

void NeedleChannel::addTip(const MaterialPoint& place, const Vec3& X, double force) {
  anchors_.push_back(
      {place, X, length_ + std::min(force, settings_.cutting_force) / stiffness_, 0.0});
  has_tip_ = true;
}

void NeedleChannel::remove(std::size_t k) {
  if (k + 1 == anchors_.size()) has_tip_ = false;
  anchors_.erase(anchors_.begin() + static_cast<std::ptrdiff_t>(k));
}

NeedleChannel::Limits NeedleChannel::limits(std::size_t k) const {
  const double friction = settings_.shaft_friction * anchors_[k].share;
  return {friction, friction + (isTip(k) ? settings_.cutting_force : 0.0)};
}

bool NeedleChannel::wantsTip(const Points& x) const {
  if (!has_tip_) return true;
  const Vec3 p = anchors_.back().place.of(x);
  return axis_.dot(p - origin_) < length_ - spacing_;
}

double NeedleChannel::tipForce(const Points& x) const {
  if (!has_tip_) return 0.0;
  const std::size_t tip = anchors_.size() - 1;
  const Limits limit = limits(tip);
  return std::clamp(stiffness_ * along(tip, anchors_[tip].place.of(x)), -limit.lower, limit.upper);
}

Vec3 NeedleChannel::gradient(std::size_t k, const Vec3& p) const {
  const Limits limit = limits(k);
  const Vec3 r = p - origin_;
  const double pull = std::clamp(stiffness_ * along(k, p), -limit.lower, limit.upper);
  return stiffness_ * (r - axis_ * axis_.dot(r)) - pull * axis_;
}

double NeedleChannel::value(const Points& x) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < anchors_.size(); ++k) {
    const Vec3 p = anchors_[k].place.of(x), r = p - origin_;
    const Limits limit = limits(k);
    const double w = along(k, p), pull = std::clamp(stiffness_ * w, -limit.lower, limit.upper);
    sum += 0.5 * stiffness_ * (r - axis_ * axis_.dot(r)).squaredNorm() +
           pull * (w - 0.5 * pull / stiffness_);
  }
  return sum;
}

double NeedleChannel::addGradient(const Points& x, Points* g) const {
  for (std::size_t k = 0; k < anchors_.size(); ++k) {
    const MaterialPoint& at = anchors_[k].place;
    const Vec3 force = gradient(k, at.of(x));
    for (int i = 0; i < 4; ++i) g->col(at.nodes[i]) += at.weights[i] * force;
  }
  return value(x);
}

// Convex: one for all tangents.
void NeedleChannel::addHessian(const Points& x, fem::Tangent, fem::Stiffness* K) const {
  for (std::size_t k = 0; k < anchors_.size(); ++k) {
    const MaterialPoint& at = anchors_[k].place;
    const Limits limit = limits(k);
    const double pull = stiffness_ * along(k, at.of(x));
    Mat3 H = stiffness_ * Mat3::Identity();
    if (pull < -limit.lower || pull > limit.upper) H -= stiffness_ * axis_ * axis_.transpose();
    K->addPoint<4>(at.nodes, at.weights, H);
  }
}

void NeedleChannel::endStep(const Points& x) {
  pulls_.clear();
  for (std::size_t k = 0; k < anchors_.size(); ++k) {
    const Vec3 p = anchors_[k].place.of(x);
    pulls_.push_back({anchors_[k].place, p, gradient(k, p)});
  }
  double next = length_;  // where the one before the last, seen from the tip, is
  for (std::size_t k = anchors_.size(); k-- > 0;) {
    Anchor& anchor = anchors_[k];
    const Limits limit = limits(k);
    const double z = axis_.dot(anchor.place.of(x) - origin_);
    const double pull = std::clamp(stiffness_ * (anchor.at - z), -limit.lower, limit.upper);
    anchor.at = z + pull / stiffness_;
    anchor.share = std::max(next - z, 0.0);
    next = std::min(next, z);
    if (z > length_ + kFree * spacing_) remove(k);
  }
}

void NeedleChannel::save(StateWriter* to) const {
  to->put(has_tip_);
  to->put(static_cast<int>(anchors_.size()));
  for (const Anchor& a : anchors_) {
    to->put(a.place.nodes);
    to->put(a.place.weights);
    to->put(a.X);
    to->put(a.at);
    to->put(a.share);
  }
}

void NeedleChannel::restore(StateReader* from, Eigen::Index points) {
  int size = 0;
  from->get(&has_tip_);
  from->get(&size);
  anchors_.clear();
  for (int k = 0; k < size; ++k) {
    Anchor& a = anchors_.emplace_back();
    from->get(&a.place.nodes);
    if (a.place.nodes.minCoeff() < 0 || a.place.nodes.maxCoeff() >= points) StateReader::fail();
    from->get(&a.place.weights);
    from->get(&a.X);
    from->get(&a.at);
    from->get(&a.share);
  }
}

}  // namespace palpate::contact
