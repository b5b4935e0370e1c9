// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/plane_statics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace palpate::skin::plane_statics_test {
namespace {

constexpr double kE = 2.0e5;

// Squares over [x0, x1] x [0, height], with nodes inside pushed about at random.
PlaneMesh patch(double x0, double x1, double height, int columns, int rows, double disorder) {
  PlaneMesh mesh;
  mesh.points.resize(2, (columns + 1) * (rows + 1));
  std::mt19937 rng{7};
  std::uniform_real_distribution<double> push(-disorder, disorder);
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      const bool inside = i > 0 && i < columns && j > 0 && j < rows;
      const double dx = (x1 - x0) / columns, dz = height / rows;
      mesh.points.col(i * (rows + 1) + j) << x0 + dx * (i + (inside ? push(rng) : 0.0)),
          dz * (j + (inside ? push(rng) : 0.0));
    }
  }
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const int a = i * (rows + 1) + j, b = a + rows + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({b + 1, a + 1, b});
    }
  }
  mesh.materials.assign(mesh.triangles.size(), 0);
  return mesh;
}

// With the edge moved by an affine motion, the inside follows it: the patch test.
TEST(PlaneStatics, PassThePatchTest) {
  const PlaneMesh mesh = patch(0.0, 1.0, 0.8, 5, 4, 0.3);
  Eigen::Matrix2d gradient;
  gradient << 0.01, -0.02, 0.005, 0.03;
  const PlanePoints expected = gradient * mesh.points;
  PlanePoints held = PlanePoints::Zero(2, mesh.points.cols());
  for (int i = 0; i < held.cols(); ++i) {
    const double x = mesh.points(0, i), z = mesh.points(1, i);
    if (x == 0.0 || x == 1.0 || z == 0.0 || z == 0.8) held.col(i).setOnes();
  }
  for (const Idealization kind : {Idealization::kPlaneStress, Idealization::kPlaneStrain,
                                  Idealization::kPlaneStressPublished}) {
    const auto K = stiffness(mesh, {elasticityMatrix(kind, kE, 0.4)}, kind, 0.01);
    const PlanePoints moved = displacements(K, PlanePoints::Zero(2, held.cols()), held, expected);
    EXPECT_LT((moved - expected).cwiseAbs().maxCoeff(), 1e-12) << toString(kind);
  }
}

// Lame's thick cylinder, radii 1 and 2, pressure p inside, no strain along it.
double radialError(int columns) {
  constexpr double a = 1.0, b = 2.0, height = 0.5, p = 1e4, nu = 0.3;
  constexpr double kPi = 3.14159265358979323846;
  const int rows = columns / 2;
  const PlaneMesh mesh = patch(a, b, height, columns, rows, 0.0);
  const Eigen::Index n = mesh.points.cols();
  PlanePoints held = PlanePoints::Zero(2, n), forces = PlanePoints::Zero(2, n);
  held.row(1).setOnes();
  for (int j = 0; j <= rows; ++j) {
    forces(0, j) = p * 2.0 * kPi * a * height / rows * (j == 0 || j == rows ? 0.5 : 1.0);
  }
  const Idealization rings = Idealization::kAxisymmetric;
  const auto K = stiffness(mesh, {elasticityMatrix(rings, kE, nu)}, rings, 0.0);
  const PlanePoints moved = displacements(K, forces, held, PlanePoints::Zero(2, n));
  double worst = 0.0, largest = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double r = mesh.points(0, i);
    const double exact =
        (1.0 + nu) * p * a * a / (kE * (b * b - a * a)) * ((1.0 - 2.0 * nu) * r + b * b / r);
    worst = std::max(worst, std::abs(moved(0, i) - exact));
    largest = std::max(largest, exact);
  }
  return worst / largest;
}

TEST(PlaneStatics, AThickCylinderConverges) {
  const double coarse = radialError(8), middle = radialError(16), fine = radialError(32);
  EXPECT_LT(coarse, 0.02);
  // Second order in the sides: a quarter from mesh to mesh.
  EXPECT_LT(middle, 0.35 * coarse);
  EXPECT_LT(fine, 0.35 * middle);
}

TEST(PlaneStatics, RefuseABodyThatIsNotHeld) {
  const PlaneMesh mesh = patch(0.0, 1.0, 1.0, 2, 2, 0.0);
  const Idealization kind = Idealization::kPlaneStress;
  Eigen::SparseMatrix<double> K = stiffness(mesh, {elasticityMatrix(kind, kE, 0.3)}, kind, 1.0);
  K.coeffRef(0, 0) -= 1.0 + K.coeff(0, 0);  // rounding alone may leave a free body positive
  const PlanePoints none = PlanePoints::Zero(2, mesh.points.cols());
  EXPECT_THROW(displacements(K, none, none, none), std::domain_error);
}

TEST(PlaneStatics, NothingMovesWhereAllIsHeld) {
  const PlaneMesh mesh = patch(0.0, 1.0, 1.0, 2, 2, 0.0);
  const Idealization kind = Idealization::kPlaneStress;
  const auto K = stiffness(mesh, {elasticityMatrix(kind, kE, 0.3)}, kind, 1.0);
  const PlanePoints none = PlanePoints::Zero(2, mesh.points.cols());
  const PlanePoints all = PlanePoints::Ones(2, mesh.points.cols());
  EXPECT_EQ(displacements(K, none, all, 0.5 * all), 0.5 * all);
}

}  // namespace
}  // namespace palpate::skin::plane_statics_test
