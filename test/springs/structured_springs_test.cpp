// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/structured_springs.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "palpate/springs/spring_network.h"

namespace palpate::springs::structured_springs_test {
namespace {

constexpr double E = 1.0e7, h = 0.1, U = 2.0, kDegree = 3.14159265358979323846 / 180.0;
const Sheet kSheet{E, 0.3, h};

/// An infinite regular sheet: the springs that one node owns, half of those that meet in it.
struct Stencil {
  std::vector<std::pair<Eigen::Vector2d, Spring>> springs;
  double cell;  // area of a node

  void add(const Eigen::Vector2d& d, const StencilSpring& s) {
    springs.push_back(
        {d, Spring{0, 1, s.stiffness, s.preload, 0.0, d.norm(), SpringKind::kStructural}});
  }
};

Stencil squares(const RectangleSprings& s) {
  Stencil stencil{{}, U * U};
  for (const Eigen::Vector2d& axis : {Eigen::Vector2d(U, 0), Eigen::Vector2d(0, U)}) {
    stencil.add(axis, s.structural);
    stencil.add(2 * axis, s.flexion);
  }
  stencil.add({U, U}, s.shear);
  stencil.add({U, -U}, s.shear);
  return stencil;
}

Stencil triangles(const TriangleSprings& s) {
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
  const Eigen::Rotation2Dd R(angle);
  Eigen::Matrix2d strains[3];
  strains[0] << 1, 0, 0, 0;
  strains[1] << 0, 0, 0, 1;
  strains[2] << 0, 0.5, 0.5, 0;
  Mat3 C = Mat3::Zero();
  for (const auto& [d, spring] : stencil.springs) {
    Eigen::Matrix<double, 3, 3> moves = Mat3::Zero();  // of the far end, a column a strain
    for (int i = 0; i < 3; ++i) {
      moves.col(i).head<2>() =
          R.toRotationMatrix() * strains[i] * R.toRotationMatrix().transpose() * d;
    }
    C += moves.transpose() * springTangent(spring, Vec3(d.x(), d.y(), 0.0)) * moves;
  }
  return C / stencil.cell;
}

// Force per length and strain of a strip that is pulled in direction `angle` and free to contract,
// as part of E h; and the contraction. It may shear as well, or, as [Wang 2005] assumes, may not.
struct Pulled {
  double modulus, poisson_ratio;
};
Pulled pull(const Stencil& stencil, double angle) {
  const Mat3 S = planeStiffness(stencil, angle).inverse();
  return {1.0 / S(0, 0) / (E * h), -S(0, 1) / S(0, 0)};
}
Pulled pullStraight(const Stencil& stencil, double angle) {
  const Eigen::Matrix2d S = planeStiffness(stencil, angle).topLeftCorner<2, 2>().inverse();
  return {1.0 / S(0, 0) / (E * h), -S(0, 1) / S(0, 0)};
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

const double kAngles[] = {0.0, 22.5 * kDegree, 45.0 * kDegree, 77.0 * kDegree};

TEST(StructuredSprings, ALineHasTheConstantsOfItsBeam) {
  const BeamSection beam = rectangularSection(E, 0.3, 0.1);
  const double EI = E * beam.second_moment, EA = E * beam.area;
  const LineSprings s = lineSprings(beam, U, 0.01 * EA / U);
  const double P1 = s.structural.preload, P2 = s.flexion.preload;
  EXPECT_NEAR(P1 + 8 * P2, -12 * EI / (U * U), 1e-12 * EI);                           // (5.15)
  EXPECT_NEAR(P1 + 2 * P2, 0.0, 1e-12 * P1);                                          // (5.18)
  EXPECT_NEAR(s.structural.stiffness + 4 * s.flexion.stiffness, EA / U, 1e-12 * EA);  // (5.26)
  EXPECT_NEAR(lineSprings(beam, U).structural.stiffness, EA / U, 1e-12 * EA);         // (5.29)
  EXPECT_THROW(lineSprings(beam, U, 0.3 * EA / U), std::invalid_argument);
  EXPECT_THROW(lineSprings(beam, U, -1.0), std::invalid_argument);
}

TEST(StructuredSprings, SheetsAreInBalanceAndFreeOfMeanStress) {
  for (const Stencil& stencil :
       {squares(rectangleSprings(kSheet, U)), triangles(triangleSprings(kSheet, U)),
        triangles(bendingTriangleSprings(kSheet, U))}) {
    Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();
    double largest = 0.0;
    for (const auto& [d, spring] : stencil.springs) {
      stress += spring.preload / d.norm() * d * d.transpose();
      largest = std::max(largest, spring.preload * d.norm());
    }
    EXPECT_LT(stress.norm(), 1e-12 * largest);
  }
}

// (5.77): (3 nu - 1)/4 of D, in every direction.
TEST(StructuredSprings, CylindricalBendingIsOffByThePoissonRatio) {
  const double rho = 1e-4 / U;
  for (const double angle : kAngles) {
    // The next order, stretch of the springs, is (rho U)^2 U^2/h^2.
    EXPECT_NEAR(bend(squares(rectangleSprings(kSheet, U)), angle, rho), 1 - 0.025, 1e-5);
    EXPECT_NEAR(bend(triangles(triangleSprings(kSheet, U)), angle, rho), 1 - 0.025, 1e-5);
  }
  const Sheet third{E, 1.0 / 3.0, h};
  const double D_ratio = third.bendingStiffness() / kSheet.bendingStiffness();
  EXPECT_NEAR(bend(squares(rectangleSprings(third, U)), 0.3, rho), D_ratio, 1e-5);
}

// (5.107): (3 nu - 1)/(3 (1 - nu)) of E h, and Poisson's ratio 1/3, in every direction. The
// triangles' preload turns with the springs, which adds a part of h^2/U^2 = 1/400.
TEST(StructuredSprings, UniaxialStretchIsOffByThePoissonRatio) {
  const double error = (3 * 0.3 - 1) / (3 * (1 - 0.3));
  EXPECT_NEAR(error, -0.0476, 0.00005);
  for (const double angle : kAngles) {
    const Pulled square = pull(squares(rectangleSprings(kSheet, U)), angle);
    const Pulled triangle = pull(triangles(triangleSprings(kSheet, U)), angle);
    EXPECT_NEAR(square.modulus, 1 + error, h * h / (U * U)) << angle;
    EXPECT_NEAR(square.poisson_ratio, 1.0 / 3.0, h * h / (U * U)) << angle;
    EXPECT_NEAR(triangle.modulus, 1 + error, h * h / (U * U)) << angle;
    EXPECT_NEAR(triangle.poisson_ratio, 1.0 / 3.0, h * h / (U * U)) << angle;
  }
}

TEST(StructuredSprings, ThePrintedConstantsOfSquaresDependOnTheDirection) {
  const Stencil stencil = squares(rectangleSprings(kSheet, U, Constants::kPrinted));
  EXPECT_NEAR(pullStraight(stencil, 0.0).modulus, 0.535, 0.001);
  EXPECT_NEAR(pullStraight(stencil, 22.5 * kDegree).modulus, 0.714, 0.001);
  EXPECT_NEAR(pullStraight(stencil, 45.0 * kDegree).modulus, 0.857, 0.001);
  EXPECT_NEAR(pullStraight(stencil, 0.0).poisson_ratio, 0.50, 0.005);
  EXPECT_NEAR(pullStraight(stencil, 45.0 * kDegree).poisson_ratio, 0.20, 0.005);
}

TEST(StructuredSprings, PrintedFormulas) {
  const double nu = 0.3, root3 = std::sqrt(3.0), Eh = E * h / (1 - nu);
  const RectangleSprings r = rectangleSprings(kSheet, U);
  EXPECT_NEAR(r.structural.preload, Eh * h * h / (2 * U), 1e-9);
  EXPECT_NEAR(r.flexion.preload, -Eh * h * h / (8 * U), 1e-9);
  EXPECT_NEAR(r.shear.preload, -std::sqrt(2.0) * Eh * h * h / (8 * U), 1e-9);
  const double k1 = r.structural.stiffness, k3 = r.shear.stiffness;
  EXPECT_NEAR(k1 + 2 * k3, Eh, 1e-12 * Eh);                        // (5.86)
  EXPECT_NEAR(k1 - 2 * k3, Eh * h * h / (2 * U * U), 1e-12 * Eh);  // (5.100)
  const TriangleSprings t = triangleSprings(kSheet, U);
  EXPECT_NEAR(t.structural.preload, root3 * Eh * h * h / (9 * U), 1e-9);  // (5.114)
  EXPECT_NEAR(t.flexion.preload, -root3 * Eh * h * h / (18 * U), 1e-9);   // (5.115)
  EXPECT_NEAR(t.structural.stiffness, root3 * Eh / 3, 1e-9 * Eh);         // (5.152)
  const TriangleSprings b = bendingTriangleSprings(kSheet, U);
  EXPECT_NEAR(b.structural.stiffness, root3 * Eh * h * h / (9 * U * U), 1e-9);  // (5.116)
  EXPECT_NEAR(b.flexion.stiffness, root3 * Eh * h * h / (72 * U * U), 1e-9);    // (5.117)
  EXPECT_THROW(rectangleSprings({E, 0.3, 3.0}, U), std::invalid_argument);
}

TEST(StructuredSprings, CubesKeepTheirConditions) {
  const double edge = 0.7, Eh = E * edge;
  for (const CubeDiagonals diagonals : {CubeDiagonals::kFaces, CubeDiagonals::kBody}) {
    const CubeSprings s = cubeSprings(E, edge, diagonals);
    EXPECT_NEAR(3 * s.edge - 3 * s.face_diagonal - 8 * s.body_diagonal, 0.0, 1e-12 * Eh);  // (7.69)
    EXPECT_NEAR(s.edge + 4 * s.face_diagonal + 4 * s.body_diagonal, 2 * Eh, 1e-12 * Eh);
    const CubeSprings printed = cubeSprings(E, edge, diagonals, Constants::kPrinted);
    EXPECT_DOUBLE_EQ(printed.edge, 2 * s.edge);
    EXPECT_DOUBLE_EQ(printed.face_diagonal + printed.body_diagonal,
                     2 * (s.face_diagonal + s.body_diagonal));
  }
  EXPECT_NEAR(cubeSprings(E, edge, CubeDiagonals::kFaces).edge, 0.4 * Eh, 1e-12 * Eh);
  EXPECT_NEAR(cubeSprings(E, edge, CubeDiagonals::kBody).body_diagonal, 0.3 * Eh, 1e-12 * Eh);
}

}  // namespace
}  // namespace palpate::springs::structured_springs_test
