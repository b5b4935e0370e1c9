// SPDX-License-Identifier: GPL-3.0-or-later
// Plane boundary elements: rigid motions, the square in tension, and a plate of the literature,
// compared with linear triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "palpate/bem/plane_plate.h"

namespace palpate::bem::plane_elements_test {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;

constexpr double kYoung = 2.0, kPoisson = 0.3;

// A square of side L from the origin, 4 n elements, turned by `angle` about it.
PlaneElements square(int n, double L, const PlaneSolid& solid, double angle = 0.0) {
  Matrix2Xd points(2, 4 * n);
  Eigen::Matrix2Xi ends(2, 4 * n);
  for (int k = 0; k < 4 * n; ++k) {
    const double s = L * (k % n) / n;
    const Vector2d at[4] = {{s, 0.0}, {L, s}, {L - s, L}, {0.0, L - s}};
    points.col(k) = Eigen::Rotation2Dd(angle) * at[k / n];
    ends.col(k) << k, (k + 1) % (4 * n);
  }
  return {points, ends, solid};
}

Eigen::VectorXd flat(const Matrix2Xd& field) {
  return Eigen::Map<const Eigen::VectorXd>(field.data(), field.size());
}

// Of 4 n elements; a displacement does no traction. That of a translation is the rows' sum; the
// integrals of neighbours at a distance of half their length are what ten points leave an error in.
TEST(PlaneElements, KnowTranslations) {
  for (const int n : {5, 20}) {
    const PlaneElements elements = square(n, 0.1, planeStrain(kYoung, kPoisson), 0.3);
    Matrix2Xd u(2, elements.size());
    u.colwise() = Vector2d(0.6, -0.8);
    EXPECT_LT((elements.displacementMatrix() * flat(u)).cwiseAbs().maxCoeff(), 1e-5) << n;
  }
}

// A rotation is not constant on an element: what is left is of the order of their length.
TEST(PlaneElements, KnowRotationsBetterTheShorterTheyAre) {
  double last = 0.0;
  for (const int n : {5, 10, 20, 40}) {
    const PlaneElements elements = square(n, 1.0, planeStrain(kYoung, kPoisson));
    Matrix2Xd u(2, elements.size());
    u << -elements.middles().row(1), elements.middles().row(0);
    const double left = (elements.displacementMatrix() * flat(u)).cwiseAbs().maxCoeff();
    EXPECT_LT(left, 0.5 / n);
    if (last > 0.0) {
      EXPECT_LT(left, last / 1.7) << n;  // first order is 2
    }
    last = left;
  }
}

// G maps the tractions of a uniform stress to what H makes of its displacements.
TEST(PlaneElements, StretchASquare) {
  for (const bool stress : {false, true}) {
    double last = 0.0;
    for (const int n : {5, 10, 20, 40}) {
      const auto solid = (stress ? planeStress : planeStrain)(kYoung, kPoisson);
      const PlaneElements elements = square(n, 1.0, solid);
      PlaneConditions conditions(4 * n);
      for (int k = 0; k < n; ++k) {
        conditions.held(1, k) = true;          // lower: guided
        conditions.value(0, n + k) = 1.0;      // right: pulled
        conditions.held(0, 3 * n + k) = true;  // left: guided
      }
      const PlaneSolution found = elements.solve(conditions);
      // Plane strain: E / (1 - nu^2) and nu / (1 - nu) in the place of E and nu.
      const double E = stress ? kYoung : kYoung / (1.0 - kPoisson * kPoisson);
      const double nu = stress ? kPoisson : kPoisson / (1.0 - kPoisson);
      Matrix2Xd right = elements.middles() / E;
      right.row(1) *= -nu;
      const double off = (found.displacement - right).cwiseAbs().maxCoeff() * E;
      EXPECT_LT(off, 0.5 / n) << n;
      if (last > 0.0) {
        EXPECT_LT(off, last / 1.7) << n;
      }
      last = off;
      const Vector2d inside = elements.displacement(Vector2d(0.5, 0.5), found);
      EXPECT_LT((inside - 0.5 * Vector2d(1.0, -nu) / E).norm() * E, 0.5 / n);
      std::printf("%s, %d elements: off by %.2g at the boundary, %.2g in the middle\n",
                  stress ? "plane stress" : "plane strain", 4 * n, off,
                  (inside - 0.5 * Vector2d(1.0, -nu) / E).norm() * E);
    }
  }
}

// With ln(1/r) a square of 2.1 would be one on which a constant traction displaces nothing.
TEST(PlaneElements, DoNotMindTheUnit) {
  PlaneConditions conditions(20);
  conditions.value.row(0).segment(5, 5).setOnes();
  conditions.held.rightCols(5).setConstant(true);
  const Matrix2Xd u = square(5, 1.0, planeStress(kYoung, kPoisson)).solve(conditions).displacement;
  for (const double L : {1e-3, 2.1, 50.0}) {
    const Matrix2Xd v = square(5, L, planeStress(kYoung, kPoisson)).solve(conditions).displacement;
    EXPECT_LT((v / L - u).cwiseAbs().maxCoeff(), 1e-10 * u.cwiseAbs().maxCoeff()) << L;
  }
}

// [Castillo Leon 2011, ch. 5] finds the same deformation. Constant elements of length h are the
// coarser of the two: h / 2 of the largest displacement.
TEST(PlanePlate, OfTwentyElementsDeformsAsThatOfFourHundredTriangles) {
  const PlateOfTriangles triangles = plateOfTriangles({}, 10);
  ASSERT_EQ(triangles.triangles.cols(), 400);
  ASSERT_EQ(triangles.matrix.rows(), 442);
  EXPECT_EQ(triangles.matrix.nonZeros(), 5844);  // by structure; 5198 are published
  const PlateOfElements plate = plateOfElements({}, 5);
  ASSERT_EQ(plate.elements.displacementMatrix().rows(), 40);
  const double most = triangles.displacement.cwiseAbs().maxCoeff();
  double off = 0.0, off_inside = 0.0;
  for (Eigen::Index i = 0; i < triangles.points.cols(); ++i) {
    const Vector2d X = triangles.points.col(i), u = triangles.displacement.col(i);
    for (Eigen::Index k = 0; k < 20; ++k) {
      if ((plate.elements.middles().col(k) - X).norm() > 1e-9) continue;
      off = std::max(off, (plate.solution.displacement.col(k) - u).norm());
    }
    if (X.minCoeff() > 0.19 && X.maxCoeff() < 0.81) {
      off_inside =
          std::max(off_inside, (plate.elements.displacement(X, plate.solution) - u).norm());
    }
  }
  std::printf("20 elements and 400 triangles: %.2f %% apart on the boundary, %.2f %% inside\n",
              100.0 * off / most, 100.0 * off_inside / most);
  EXPECT_GT(off, 0.0);
  EXPECT_LT(off, 0.5 * 0.2 * most);
  EXPECT_LT(off_inside, 0.5 * 0.2 * most);
}

// Both go to the same plate.
TEST(PlanePlate, IsTheSameOfManyElementsAndTriangles) {
  const auto end = [](int cells) {
    const PlateOfTriangles t = plateOfTriangles({}, cells);
    return t.displacement(0, cells / 2 * (cells + 1) + cells);
  };
  const double coarse = end(20), fine = end(40);
  const double right = fine + (fine - coarse) / 3.0;  // second order but for the clamp's corners
  double last = 1.0;
  for (const int n : {5, 15, 45}) {
    const PlateOfElements plate = plateOfElements({}, n);
    const double off = std::abs(plate.solution.displacement(0, n + n / 2) / right - 1.0);
    std::printf("%d elements: the end is off by %.2g\n", 4 * n, off);
    EXPECT_LT(off, 0.5 / n);
    EXPECT_LT(off, last / 2.0);  // first order is 3
    last = off;
  }
}

TEST(PlaneElements, RefuseWhatTheyCannotSolve) {
  EXPECT_THROW(planeStrain(0.0, 0.3), std::invalid_argument);
  EXPECT_THROW(planeStress(1.0, 0.5), std::invalid_argument);
  const PlaneElements elements = square(5, 1.0, planeStrain(kYoung, kPoisson));
  EXPECT_THROW(elements.solve(PlaneConditions(20)), std::invalid_argument);
  EXPECT_THROW(elements.solve(PlaneConditions(19)), std::invalid_argument);
  Matrix2Xd points(2, 2);
  points << 0, 1, 0, 0;
  Eigen::Matrix2Xi ends(2, 1);
  ends << 0, 2;
  EXPECT_THROW(PlaneElements(points, ends, planeStrain(1.0, 0.3)), std::invalid_argument);
  ends << 1, 1;
  EXPECT_THROW(PlaneElements(points, ends, planeStrain(1.0, 0.3)), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::bem::plane_elements_test
