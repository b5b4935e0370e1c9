// SPDX-License-Identifier: GPL-3.0-or-later
// The surface's stiffness by the formulas as they stand, entry by entry, and what it would be
// without the equation of tractions.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cstdio>

#include "bem/surface_operators.h"
#include "palpate/bem/surface_stiffness.h"
#include "surfaces.h"

namespace palpate::bem::plain_stiffness_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

const material::Moduli kSolid = material::moduliFromYoung(2.0, 0.3);

struct Plain {
  explicit Plain(const mesh::SurfaceMesh& surface)
      : triangles(trianglesOf(surface)), of(surfaceOperators(surface, triangles, kSolid, nullptr)) {
    const Index m = surface.triangles.cols(), n = surface.points.cols();
    M.setZero(3 * m, 3 * n);
    turn.setZero(3 * m, 3 * n);
    D.setZero(3 * n, 3 * n);
    MatrixXd K1 = MatrixXd::Zero(3 * m, 3 * n), V1 = MatrixXd::Zero(3 * m, 3 * m);
    for (Index t = 0; t < m; ++t) {
      const Triangle& triangle = triangles[static_cast<std::size_t>(t)];
      for (int a = 0; a < 3; ++a) {
        const Index column = 3 * surface.triangles(a, t);
        M.block<3, 3>(3 * t, column) = triangle.area / 3.0 * Mat3::Identity();
        turn.block<3, 3>(3 * t, column) = turning(triangle, a);
      }
      for (Index i = 0; i < n; ++i) {
        K1.block<3, 3>(3 * t, 3 * i) = of.double_layer(t, i) * Mat3::Identity();
      }
      for (Index s = 0; s < m; ++s) {
        V1.block<3, 3>(3 * t, 3 * s) = of.inverse(t, s) * Mat3::Identity();
      }
    }
    B = 0.5 * M + K1 - V1 * turn + 2.0 * kSolid.mu * of.single_layer * turn;
    for (Index s = 0; s < m; ++s) {
      for (Index t = 0; t < m; ++t) addPair(surface, s, t);
    }
  }

  static Mat3 turning(const Triangle& t, int a) {
    const Vec3 g = t.gradients.col(a);
    return g * t.normal.transpose() - t.normal * g.transpose();
  }

  // Han's three terms, of which V has 1/(4 pi) and 1/(16 pi mu ...) in it.
  void addPair(const mesh::SurfaceMesh& surface, Index s, Index t) {
    const Triangle &over = triangles[static_cast<std::size_t>(s)],
                   &source = triangles[static_cast<std::size_t>(t)];
    const double mu = kSolid.mu, V1 = of.inverse(s, t);
    const Mat3 V = of.single_layer.block<3, 3>(3 * s, 3 * t);
    for (int a = 0; a < 3; ++a) {
      const Mat3 Ma = turning(over, a);
      const Vec3 ca = over.normal.cross(Vec3(over.gradients.col(a)));
      for (int b = 0; b < 3; ++b) {
        const Mat3 Mb = turning(source, b);
        const Vec3 cb = source.normal.cross(Vec3(source.gradients.col(b)));
        const Mat3 pair =
            mu * V1 * ca.dot(cb) * Mat3::Identity() +
            Ma.transpose() * (2.0 * mu * V1 * Mat3::Identity() - 4.0 * mu * mu * V) * Mb +
            mu * V1 * Mb.transpose() * Ma;
        D.block<3, 3>(3 * surface.triangles(a, s), 3 * surface.triangles(b, t)) += pair;
      }
    }
  }

  std::vector<Triangle> triangles;
  SurfaceOperators of;
  MatrixXd M, turn, B, D;
};

TEST(PlainStiffness, IsTheSame) {
  // A cavity, of which nothing is projected out.
  const mesh::SurfaceMesh surface = sphere(1, 0.7, false);
  const Plain plain(surface);
  const MatrixXd S = plain.D + plain.B.transpose() * plain.of.single_layer.llt().solve(plain.B);
  const MatrixXd made = surfaceStiffness(surface, kSolid).matrix;
  EXPECT_LT((S - made).norm(), 1e-11 * made.norm());
}

// Tractions of displacements, tested with displacements: M^T V^-1 B alone. It knows uniform stress
// as S does, but is not symmetric: what made it so by averaging would be another stiffness, which
// is why the equation of tractions is there.
TEST(PlainStiffness, WithoutTractionsIsNotSymmetric) {
  const mesh::SurfaceMesh surface = test::boxSurface(Vec3(1.0, 1.2, 0.9), Eigen::Vector3i(3, 3, 3));
  const Plain plain(surface);
  const MatrixXd S = surfaceStiffness(surface, kSolid).matrix;
  const MatrixXd one_sided = plain.M.transpose() * plain.of.single_layer.llt().solve(plain.B);
  const double skew = (one_sided - one_sided.transpose()).norm() / one_sided.norm();
  const MatrixXd mean = 0.5 * (one_sided + one_sided.transpose());
  const double apart = (mean - S).norm() / S.norm();
  std::printf("M^T V^-1 B: %.3f of it not symmetric, its mean with its transpose %.3f from S\n",
              skew, apart);
  EXPECT_GT(skew, 0.02);
  EXPECT_GT(apart, 0.02);
  // Work of a smooth motion is the same by both, to the elements' order.
  const Points u = surface.points.array().square().matrix();
  const auto flat = Eigen::Map<const Eigen::VectorXd>(u.data(), u.size());
  const double h = 0.4;
  EXPECT_NEAR(flat.dot(one_sided * flat), flat.dot(S * flat), h * h * flat.dot(S * flat));
}

}  // namespace
}  // namespace palpate::bem::plain_stiffness_test
