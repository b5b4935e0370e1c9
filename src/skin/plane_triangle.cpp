// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/plane_triangle.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace palpate::skin {
namespace {

constexpr std::array<std::string_view, 4> kNames = {"plane_stress_published", "plane_stress",
                                                    "plane_strain", "axisymmetric"};
constexpr double kPi = 3.14159265358979323846;

}  // namespace

std::string_view toString(Idealization idealization) {
  return kNames[static_cast<std::size_t>(idealization)];
}

std::vector<std::string> idealizationNames() { return {kNames.begin(), kNames.end()}; }

Idealization idealizationOf(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<Idealization>(i);
  }
  throw std::invalid_argument("no idealization \"" + std::string(name) + "\"");
}

Eigen::Matrix4d elasticityMatrix(Idealization idealization, double young_modulus,
                                 double poisson_ratio) {
  const double E = young_modulus, nu = poisson_ratio;
  Eigen::Matrix4d D = Eigen::Matrix4d::Zero();
  if (idealization == Idealization::kPlaneStress ||
      idealization == Idealization::kPlaneStressPublished) {
    const bool published = idealization == Idealization::kPlaneStressPublished;
    const double scale = E / (published ? 1.0 + nu * nu : 1.0 - nu * nu);
    D(0, 0) = D(1, 1) = scale;
    D(0, 1) = D(1, 0) = scale * nu;
    D(2, 2) = scale * 0.5 * (1.0 - nu);
    return D;
  }
  const double scale = E / ((1.0 + nu) * (1.0 - 2.0 * nu));
  D(0, 0) = D(1, 1) = scale * (1.0 - nu);
  D(0, 1) = D(1, 0) = scale * nu;
  D(2, 2) = scale * 0.5 * (1.0 - 2.0 * nu);
  if (idealization == Idealization::kAxisymmetric) {
    D(3, 3) = scale * (1.0 - nu);
    D(0, 3) = D(3, 0) = D(1, 3) = D(3, 1) = scale * nu;
  }
  return D;
}

double signedArea(const Corners& corners) {
  const Eigen::Vector2d a = corners.col(1) - corners.col(0), b = corners.col(2) - corners.col(0);
  return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

TriangleStrain strainMatrix(const Corners& corners, Idealization idealization) {
  const double twice = 2.0 * signedArea(corners);
  TriangleStrain B = TriangleStrain::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d j = corners.col((i + 1) % 3), k = corners.col((i + 2) % 3);
    const double by_x = (j.y() - k.y()) / twice, by_z = (k.x() - j.x()) / twice;
    B(0, 2 * i) = by_x;
    B(1, 2 * i + 1) = by_z;
    B(2, 2 * i) = by_z;
    B(2, 2 * i + 1) = by_x;
    if (idealization == Idealization::kAxisymmetric) B(3, 2 * i) = 1.0 / corners.row(0).sum();
  }
  return B;
}

TriangleStiffness triangleStiffness(const Corners& corners, const Eigen::Matrix4d& elasticity,
                                    Idealization idealization, double thickness) {
  const TriangleStrain B = strainMatrix(corners, idealization);
  const double across =
      idealization == Idealization::kAxisymmetric ? 2.0 * kPi * corners.row(0).mean() : thickness;
  return B.transpose() * elasticity * B * (std::abs(signedArea(corners)) * across);
}

}  // namespace palpate::skin
