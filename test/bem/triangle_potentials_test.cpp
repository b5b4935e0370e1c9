// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals over triangles: against a fine rule, and by what rigid motions and Kelvin's own kernel
// say of a closed surface.
#include "bem/triangle_potentials.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "bem/surface_operators.h"
#include "surfaces.h"

namespace palpate::bem::triangle_potentials_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

const material::Moduli kSolid = material::moduliFromYoung(2.0, 0.3);

Mat3 corners() { return (Mat3() << 0.1, 1.2, 0.3, -0.2, 0.1, 0.9, 0.3, 0.2, 0.6).finished(); }

// Sum of f(y, area) over 4^9 parts of a triangle.
template <class F>
void forParts(const Mat3& of, int level, const F& f) {
  if (level == 0) {
    const Vec3 twice = (of.col(1) - of.col(0)).cross(of.col(2) - of.col(0));
    f(Vec3(of.rowwise().mean()), 0.5 * twice.norm());
    return;
  }
  const Vec3 a = 0.5 * (of.col(0) + of.col(1)), b = 0.5 * (of.col(1) + of.col(2)),
             c = 0.5 * (of.col(2) + of.col(0));
  const Mat3 parts[4] = {(Mat3() << of.col(0), a, c).finished(),
                         (Mat3() << of.col(1), b, a).finished(),
                         (Mat3() << of.col(2), c, b).finished(), (Mat3() << a, b, c).finished()};
  for (const Mat3& part : parts) forParts(part, level - 1, f);
}

TEST(TrianglePotentials, AreThoseOfAFineRule) {
  const Triangle triangle(corners());
  const Vec3 n = triangle.normal, middle = triangle.middle;
  const Vec3 beside = triangle.corners.col(0) - triangle.corners.col(1);
  for (const Vec3& x : {Vec3(middle + 0.3 * n), Vec3(middle - 0.3 * n), Vec3(middle + 4.0 * n),
                        Vec3(triangle.corners.col(0) + 0.5 * beside),
                        Vec3(triangle.corners.col(0) + 0.5 * beside + 0.1 * n),
                        Vec3(triangle.corners.col(2) - 0.4 * n), Vec3(3.0, -2.0, 1.0)}) {
    double inverse = 0.0;
    Mat3 pull = Mat3::Zero();
    Vec3 cover = Vec3::Zero();
    forParts(triangle.corners, 9, [&](const Vec3& y, double area) {
      const Vec3 r = y - x;
      const double length = r.norm(), cube = length * length * length;
      const Vec3 N =
          Vec3(1.0, 0.0, 0.0) + triangle.gradients.transpose() * (y - triangle.corners.col(0));
      inverse += area / length;
      pull += area / cube * r * r.transpose();
      cover += area * r.dot(n) / cube * N;
    });
    const TrianglePotentials found = potentials(triangle, x);
    // The rule's error at a distance of 0.1 and more, with parts of 2e-3.
    EXPECT_NEAR(found.inverse, inverse, 2e-5 * inverse);
    EXPECT_LT((found.pull - pull).norm(), 2e-5 * inverse);
    EXPECT_LT((found.cover - cover).norm(), 1e-4 * std::max(cover.norm(), 0.1 * inverse));
    EXPECT_NEAR(found.pull.trace(), found.inverse, 1e-12 * inverse);
  }
}

// On the triangle 1/r is integrated as well: that of a disc's is 2 pi R.
TEST(TrianglePotentials, AreFiniteOnTheTriangle) {
  double inverse = 0.0;
  Mat3 pull = Mat3::Zero();
  const int n = 200;
  for (int k = 0; k < n; ++k) {
    const double a = 2.0 * kPi * k / n, b = 2.0 * kPi * (k + 1) / n;
    Mat3 of = Mat3::Zero();
    of.col(1) = Vec3(std::cos(a), std::sin(a), 0.0);
    of.col(2) = Vec3(std::cos(b), std::sin(b), 0.0);
    const TrianglePotentials found = potentials(Triangle(of), Vec3::Zero());
    inverse += found.inverse;
    pull += found.pull;
    EXPECT_EQ(found.cover, Vec3::Zero());
  }
  EXPECT_NEAR(inverse, 2.0 * kPi, 2.0 * kPi * kPi * kPi / (n * n));
  EXPECT_LT(
      (pull - Vec3(1.0, 1.0, 0.0).asDiagonal() * Mat3(0.5 * inverse * Mat3::Identity())).norm(),
      1e-12);
}

// u / 2 + int T u at x of the surface's point of u, by Kupradze's form; inside without the half.
Vec3 doubleLayer(const mesh::SurfaceMesh& surface, const std::vector<Triangle>& triangles,
                 const Points& u, const Vec3& x, int on = -1) {
  const KelvinConstants kelvin(kSolid);
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& of = triangles[t];
    const TrianglePotentials at = potentials(of, x);
    Mat3 gradient = Mat3::Zero();  // of u along the surface
    for (int a = 0; a < 3; ++a) {
      const Vec3 value = u.col(surface.triangles(a, static_cast<Eigen::Index>(t)));
      gradient += value * of.gradients.col(a).transpose();
      if (static_cast<int>(t) != on) sum -= at.cover[a] / (4.0 * kPi) * value;
      if (static_cast<int>(t) == on) sum += value / 6.0;
    }
    // (M u)_i = g_i n_j u_j - n_i g_j u_j
    const Vec3 turned = gradient.transpose() * of.normal - of.normal * gradient.trace();
    const Mat3 U = kelvin.factor * (kelvin.isotropic * at.inverse * Mat3::Identity() + at.pull);
    sum += 2.0 * kSolid.mu * U * turned - at.inverse / (4.0 * kPi) * turned;
  }
  return sum;
}

Points shaken(const Points& X, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return X + 0.05 * Points::NullaryExpr(3, X.cols(), [&] { return uniform(random); });
}

// Any motion of a rigid body leaves no traction, at any point of a surface without symmetry.
TEST(TrianglePotentials, KnowRigidMotions) {
  for (const bool hollow : {false, true}) {
    mesh::SurfaceMesh surface = test::boxSurface(Vec3(1.0, 1.2, 0.8), Eigen::Vector3i(3, 3, 2));
    if (hollow) surface = test::joined(sphere(1, 2.0), sphere(1, 0.7, false));
    surface.points = shaken(surface.points, 7);
    const std::vector<Triangle> triangles = trianglesOf(surface);
    Points u = surface.points;
    for (Eigen::Index i = 0; i < u.cols(); ++i) {
      u.col(i) = Vec3(0.3, -0.2, 0.5) + Vec3(0.4, 0.7, -0.3).cross(Vec3(surface.points.col(i)));
    }
    const double size = u.colwise().norm().maxCoeff();
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      const Vec3 left =
          doubleLayer(surface, triangles, u, triangles[t].middle, static_cast<int>(t));
      EXPECT_LT(left.norm(), 1e-10 * size) << t;
    }
    const Vec3 inside = hollow ? Vec3(1.2, 0.1, 0.3) : Vec3(0.5, 0.6, 0.4);
    const Vec3 value = Vec3(0.3, -0.2, 0.5) + Vec3(0.4, 0.7, -0.3).cross(inside);
    EXPECT_LT((doubleLayer(surface, triangles, u, inside) + value).norm(), 1e-10 * size);
  }
}

// Of any displacements the form is the integral of Kelvin's tractions themselves.
TEST(TrianglePotentials, GiveTheTractionsOfKelvin) {
  mesh::SurfaceMesh surface = test::boxSurface(Vec3(1.0, 1.2, 0.8), Eigen::Vector3i(2, 2, 1));
  surface.points = shaken(surface.points, 3);
  const std::vector<Triangle> triangles = trianglesOf(surface);
  const Points u = shaken(Points::Zero(3, surface.points.cols()), 5);
  const double nu = 0.3;
  for (const Vec3& x : {Vec3(0.5, 0.6, 0.4), Vec3(0.3, 0.7, 0.5), Vec3(2.0, -1.0, 0.3)}) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Triangle& of = triangles[t];
      forParts(of.corners, 7, [&](const Vec3& y, double area) {
        const Vec3 r = y - x, e = r.normalized(), n = of.normal;
        const Vec3 N = Vec3(1.0, 0.0, 0.0) + of.gradients.transpose() * (y - of.corners.col(0));
        Vec3 value = Vec3::Zero();
        for (int a = 0; a < 3; ++a) {
          value += N[a] * u.col(surface.triangles(a, static_cast<Eigen::Index>(t)));
        }
        const Mat3 T = -1.0 / (8.0 * kPi * (1.0 - nu) * r.squaredNorm()) *
                       (e.dot(n) * ((1.0 - 2.0 * nu) * Mat3::Identity() + 3.0 * e * e.transpose()) -
                        (1.0 - 2.0 * nu) * (e * n.transpose() - n * e.transpose()));
        sum += area * T * value;
      });
    }
    const Vec3 found = doubleLayer(surface, triangles, u, x);
    EXPECT_LT((found - sum).norm(), 1e-4 * u.colwise().norm().maxCoeff());  // the rule's error
    EXPECT_GT(sum.norm(), 1e-3 * u.colwise().norm().maxCoeff());
  }
}

}  // namespace
}  // namespace palpate::bem::triangle_potentials_test
