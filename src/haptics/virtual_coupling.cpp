// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/virtual_coupling.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace palpate::haptics {
namespace {

// Time constants of a softer coupling, which loses force, and a stiffer one, which adds energy.
// Changes need a rendered stiffness outside a band around the limit, since estimates are noisy.
constexpr double kSoften = 0.05, kStiffen = 0.5;  // time constants [s]
constexpr double kReturn = 0.2;                   // return of the tool to the hand [s]
constexpr double kFar = 1.0;                      // [m]
constexpr double kTooStiff = 1.25, kTooSoft = 0.6;

// Factor on the estimated stiffness [-]: with a much softer coupling, an underestimate lets the
// tool's target diverge.
constexpr double kCaution = 1.5;

// Model of a wall: the whole force along the stiffest direction.
Mat3 wall(const ContactModel& tool, double K) {
  const Vec3 normal = tool.wrench.force.normalized();
  const Mat3 across = Mat3::Identity() - normal * normal.transpose();
  return (1.0 + kCaution) * K * normal * normal.transpose() + across * tool.stiffness_W * across;
}

double largest(const Mat3& K) {
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(K, Eigen::EigenvaluesOnly);
  return std::max(0.0, eigen.eigenvalues().maxCoeff());
}

}  // namespace

const RenderedContact& VirtualCoupling::observe(const ContactModel& tool, bool expected,
                                                const Vec3& lag, double dt) {
  const double K = largest(tool.stiffness_W), limit = limits_.maxStiffness();
  const double wanted =
      K > limit ? 1.0 / limit - 1.0 / K : 0.0;  // spring and tissue in series at the limit
  const bool touches = tool.wrench.force != Vec3::Zero();
  const bool touched = rendered_.model.wrench.force != Vec3::Zero();
  if (!touches) {
    compliance_ = 0.0;
  } else if (!touched) {
    compliance_ = wanted;  // nearly no force to change
  } else {
    const double felt = K / (1.0 + compliance_ * K) / limit;
    const double time = felt > kTooStiff ? kSoften : felt < kTooSoft ? kStiffen : 0.0;
    if (time > 0.0) compliance_ += (wanted - compliance_) * (1.0 - std::exp(-dt / time));
  }
  rendered_.model = tool;
  rendered_.expected = expected;
  if (compliance_ > 0.0) {
    rendered_.model.p_W = tool.p_W - compliance_ * tool.wrench.force;
  } else {
    rendered_.model.p_W = tool.p_W + lag - offset_;
    offset_ *= std::exp(-dt / kReturn);
  }
  rendered_.tissue_stiffness = rendered_.stiffness = K;
  if (compliance_ > 0.0) {
    const double rigid = compliance_ * K / (1.0 + compliance_ * K);
    const Mat3 stiffer = tool.stiffness_W + rigid * (wall(tool, K) - tool.stiffness_W);
    const Mat3 series = Mat3::Identity() + compliance_ * stiffer;
    const Mat3 stiffness = series.inverse() * stiffer;
    rendered_.model.stiffness_W = 0.5 * (stiffness + stiffness.transpose());
    rendered_.stiffness = K / (1.0 + compliance_ * K);
    rendered_.model.reach *= 1.0 + compliance_ * K;
  }
  rendered_.lead = limits_.lead(rendered_.stiffness);
  return rendered_;
}

void VirtualCoupling::forget() {
  compliance_ = 0.0;
  offset_.setZero();
  rendered_ = {};
}

Vec3 VirtualCoupling::target(const Vec3& p_hand) {
  if (compliance_ > 0.0) {
    ContactModel model = rendered_.model;
    model.reach = kFar;  // a deep hand must not drag its tool
    offset_ = compliance_ * model.at(p_hand).force;
  }
  return p_hand + offset_;
}

}  // namespace palpate::haptics
