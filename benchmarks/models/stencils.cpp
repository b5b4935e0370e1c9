// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <cmath>
#include <utility>
#include <vector>

#include "palpate/io/json.h"
#include "palpate/springs/spring_network.h"
#include "palpate/springs/structured_springs.h"
#include "parts.h"

namespace palpate::models {
namespace {

using namespace springs;

constexpr double kDegree = 3.14159265358979323846 / 180.0, U = 2.0;
const Sheet kSheet{1.0e7, 0.3, 0.1};

/// An infinite regular sheet: the springs that one node owns, half of those that meet in it.
struct Stencil {
  std::vector<std::pair<Eigen::Vector2d, Spring>> springs;
  double cell;  // area of a node

  void add(const Eigen::Vector2d& d, const StencilSpring& s) {
    springs.push_back(
        {d, Spring{0, 1, s.stiffness, s.preload, 0.0, d.norm(), SpringKind::kStructural}});
  }
};

Stencil squares(Constants constants) {
  const RectangleSprings s = rectangleSprings(kSheet, U, constants);
  Stencil stencil{{}, U * U};
  for (const Eigen::Vector2d& axis : {Eigen::Vector2d(U, 0), Eigen::Vector2d(0, U)}) {
    stencil.add(axis, s.structural);
    stencil.add(2 * axis, s.flexion);
  }
  stencil.add({U, U}, s.shear);
  stencil.add({U, -U}, s.shear);
  return stencil;
}

Stencil triangles() {
  const TriangleSprings s = triangleSprings(kSheet, U);
  Stencil stencil{{}, 0.5 * std::sqrt(3.0) * U * U};
  for (const double angle : {0.0, 60.0, 120.0}) {
    const Eigen::Vector2d d =
        U * Eigen::Vector2d(std::cos(angle * kDegree), std::sin(angle * kDegree));
    stencil.add(d, s.structural);
    stencil.add(2 * d, s.flexion);
  }
  return stencil;
}

// Second derivative of the energy per area by small strains (xx, yy, xy and yx), turned by `angle`.
Mat3 planeStiffness(const Stencil& stencil, double angle) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
  Eigen::Matrix2d strains[3];
  strains[0] << 1, 0, 0, 0;
  strains[1] << 0, 0, 0, 1;
  strains[2] << 0, 0.5, 0.5, 0;
  Mat3 C = Mat3::Zero();
  for (const auto& [d, spring] : stencil.springs) {
    Mat3 moves = Mat3::Zero();  // of the far end, a column a strain
    for (int i = 0; i < 3; ++i) moves.col(i).head<2>() = R * strains[i] * R.transpose() * d;
    C += moves.transpose() * springTangent(spring, Vec3(d.x(), d.y(), 0.0)) * moves;
  }
  return C / stencil.cell;
}

// Energy per area of a sheet that is bent to a cylinder of curvature rho, whose axis is across
// `angle`, in parts of D rho^2/2.
double bend(const Stencil& stencil, double angle, double rho) {
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  double energy = 0.0;
  for (const auto& [d, spring] : stencil.springs) {
    const double around = d.dot(along), chord = 2 / rho * std::sin(0.5 * rho * around);
    energy += springEnergy(spring, std::sqrt(d.squaredNorm() + chord * chord - around * around));
  }
  return energy / stencil.cell / (0.5 * kSheet.bendingStiffness() * rho * rho);
}

// A strip that is pulled and free to contract: stress over E h strain, and the contraction; free to
// shear as well, or, as [Wang 2005] assumes ("straight"), not. And cylindrical bending over D.
std::string inDirections(const Stencil& stencil, const Eigen::VectorXd& degrees) {
  const Eigen::Index n = degrees.size();
  Eigen::VectorXd modulus(n), straight(n), poisson(n), straight_poisson(n), bending(n);
  const double Eh = kSheet.young_modulus * kSheet.thickness;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = degrees[i] * kDegree;
    const Mat3 C = planeStiffness(stencil, angle), S = C.inverse();
    const Eigen::Matrix2d held = C.topLeftCorner<2, 2>().inverse();
    modulus[i] = 1.0 / S(0, 0) / Eh;
    poisson[i] = -S(0, 1) / S(0, 0);
    straight[i] = 1.0 / held(0, 0) / Eh;
    straight_poisson[i] = -held(0, 1) / held(0, 0);
    bending[i] = bend(stencil, angle, 1e-4 / U);
  }
  io::JsonMembers out;
  out.add("modulus", io::json(modulus));
  out.add("poisson_ratio", io::json(poisson));
  out.add("straight_modulus", io::json(straight));
  out.add("straight_poisson_ratio", io::json(straight_poisson));
  out.add("bending", io::json(bending));
  return out.object();
}

}  // namespace

std::string directions(bool quick) {
  const Eigen::VectorXd degrees = Eigen::VectorXd::LinSpaced(quick ? 5 : 181, 0.0, 90.0);
  io::JsonMembers out;
  out.add("degrees", io::json(degrees));
  out.add("triangles", inDirections(triangles(), degrees));
  out.add("squares", inDirections(squares(Constants::kCorrected), degrees));
  out.add("squares_as_printed", inDirections(squares(Constants::kPrinted), degrees));
  return out.object();
}

}  // namespace palpate::models
