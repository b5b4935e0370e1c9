// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/spring_network.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "palpate/base/number.h"

namespace palpate::springs {
namespace {

constexpr std::array<std::string_view, 6> kNames = {"structural", "flexion",       "shear",
                                                    "edge",       "face_diagonal", "body_diagonal"};

[[noreturn]] void refuse(const std::string& what, std::size_t index, const std::string& wrong) {
  throw std::invalid_argument(what + " " + std::to_string(index) + ": " + wrong);
}

void checkSpring(const Spring& s, std::size_t index, Eigen::Index points) {
  for (const int end : {s.a, s.b}) {
    if (end < 0 || end >= points) {
      refuse("spring", index,
             "point " + std::to_string(end) + " is none of the " + std::to_string(points));
    }
  }
  if (s.a == s.b) refuse("spring", index, "both ends are point " + std::to_string(s.a));
  if (!(s.length > 0.0 && std::isfinite(s.length))) {
    refuse("spring", index, "length = " + formatNumber(s.length) + "; must be > 0");
  }
  if (!(s.stiffness >= 0.0 && std::isfinite(s.stiffness))) {
    refuse("spring", index, "stiffness = " + formatNumber(s.stiffness) + "; must be >= 0");
  }
  if (!(s.damping >= 0.0 && std::isfinite(s.damping))) {
    refuse("spring", index, "damping = " + formatNumber(s.damping) + "; must be >= 0");
  }
  if (!std::isfinite(s.preload)) {
    refuse("spring", index, "preload = " + formatNumber(s.preload) + "; must be a number");
  }
}

}  // namespace

std::string_view toString(SpringKind kind) { return kNames[static_cast<std::size_t>(kind)]; }

std::optional<SpringKind> springKindOf(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<SpringKind>(i);
  }
  return std::nullopt;
}

std::vector<std::string> springKindNames() { return {kNames.begin(), kNames.end()}; }

double springEnergy(const Spring& s, double u) {
  const double stretch = u - s.length;
  return (s.preload + 0.5 * s.stiffness * stretch) * stretch;
}

double springForce(const Spring& s, double u) { return s.preload + s.stiffness * (u - s.length); }

Vec3 springForceOnA(const Spring& s, const Vec3& d) {
  const double u = d.norm();
  if (!(u > 0.0)) return Vec3::Zero();
  return springForce(s, u) / u * d;
}

Mat3 springTangent(const Spring& s, const Vec3& d) {
  const double u = d.norm();
  if (!(u > 0.0)) return s.stiffness * Mat3::Identity();
  const Vec3 n = d / u;
  const double across = springForce(s, u) / u;
  return across * Mat3::Identity() + (s.stiffness - across) * n * n.transpose();
}

double networkEnergy(const SpringNetwork& network, const Points& x) {
  double energy = 0.0;
  for (const Spring& s : network.springs) {
    energy += springEnergy(s, (x.col(s.b) - x.col(s.a)).norm());
  }
  return energy;
}

Points networkForces(const SpringNetwork& network, const Points& x) {
  Points forces = Points::Zero(3, x.cols());
  for (const Spring& s : network.springs) {
    const Vec3 force = springForceOnA(s, x.col(s.b) - x.col(s.a));
    forces.col(s.a) += force;
    forces.col(s.b) -= force;
  }
  return forces;
}

void checkNetwork(const SpringNetwork& network) {
  const Eigen::Index n = network.points.cols();
  if (network.masses.size() != n) {
    throw std::invalid_argument(std::to_string(network.masses.size()) + " masses for " +
                                std::to_string(n) + " points");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (!network.points.col(i).allFinite()) refuse("point", index, "is not finite");
    if (!(network.masses[i] > 0.0 && std::isfinite(network.masses[i]))) {
      refuse("point", index, "mass = " + formatNumber(network.masses[i]) + "; must be > 0");
    }
  }
  for (std::size_t i = 0; i < network.springs.size(); ++i) checkSpring(network.springs[i], i, n);
}

}  // namespace palpate::springs
