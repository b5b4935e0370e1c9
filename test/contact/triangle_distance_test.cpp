// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/triangle_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random.h"

namespace palpate::contact::triangle_distance_test {
namespace {

TrianglePoint nearest(const Mat3& x, const Vec3& p) {
  return nearestOnTriangle(p, x.col(0), x.col(1), x.col(2));
}

double bruteForce(const Mat3& x, const Vec3& p) {
  constexpr int kParts = 200;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kParts; ++i) {
    for (int j = 0; i + j <= kParts; ++j) {
      const Vec3 w = Vec3(i, j, kParts - i - j) / kParts;
      least = std::min(least, (x * w - p).norm());
    }
  }
  return least;
}

class Triangles : public ::testing::Test {
 protected:
  // Of about unit size, with a point of about that distance.
  void next() {
    const Points r = random.points(4, 1.0);
    x = r.leftCols<3>();
    p = 1.5 * r.col(3);
  }
  test::Random random;
  Mat3 x;
  Vec3 p;
};

TEST_F(Triangles, HaveTheirNearestPointWhereASearchFindsIt) {
  int faces = 0, edges = 0, vertices = 0;
  for (int trial = 0; trial < 300; ++trial) {
    next();
    const TrianglePoint near = nearest(x, p);
    const double longest = std::max(
        {(x.col(1) - x.col(0)).norm(), (x.col(2) - x.col(1)).norm(), (x.col(0) - x.col(2)).norm()});
    const double distance = (near.point - p).norm();
    EXPECT_LE(distance, bruteForce(x, p) + 1e-12);
    EXPECT_GE(distance, bruteForce(x, p) - longest / 200.0);
    EXPECT_LT((x * near.weights - near.point).norm(), 1e-12);
    EXPECT_NEAR(near.weights.sum(), 1.0, 1e-12);
    EXPECT_GE(near.weights.minCoeff(), 0.0);
    const auto zeros = (near.weights.array() == 0.0).count();
    EXPECT_EQ(zeros, near.feature == Feature::kFace ? 0 : near.feature == Feature::kEdge ? 1 : 2);
    faces += near.feature == Feature::kFace;
    edges += near.feature == Feature::kEdge;
    vertices += near.feature == Feature::kVertex;
  }
  EXPECT_GT(std::min({faces, edges, vertices}), 10);
}

// The gradient by the corners is -w m; its change is the Hessian. On both sides of the triangle,
// beyond which the distance counts as negative.
TEST_F(Triangles, HaveTheSecondDerivativeOfTheirDistance) {
  using Vec9 = Eigen::Matrix<double, 9, 1>;
  constexpr double h = 1e-6;
  int checked = 0;
  for (int trial = 0; trial < 300; ++trial) {
    next();
    const double side = trial % 2 == 0 ? 1.0 : -1.0;
    const TrianglePoint here = nearest(x, p);
    const auto gradient = [&](const Mat3& at) {
      const TrianglePoint near = nearest(at, p);
      const Vec3 m = side * (p - near.point).normalized();
      Vec9 g;
      for (int k = 0; k < 3; ++k) g.segment<3>(3 * k) = -near.weights[k] * m;
      return g;
    };
    const Vec3 way = p - here.point;
    const Eigen::Matrix<double, 9, 9> H =
        triangleDistanceHessian(x, here, side * way.normalized(), side * way.norm());
    EXPECT_LT((H - H.transpose()).norm(), 1e-10 * (1.0 + H.norm()));
    for (int k = 0; k < 9; ++k) {
      Mat3 more = x, less = x;
      more(k % 3, k / 3) += h;
      less(k % 3, k / 3) -= h;
      if (nearest(more, p).feature != here.feature || nearest(less, p).feature != here.feature) {
        continue;
      }
      const Vec9 column = (gradient(more) - gradient(less)) / (2.0 * h);
      EXPECT_LT((H.col(k) - column).norm(), 1e-5 * (1.0 + H.norm())) << trial;
      ++checked;
    }
  }
  EXPECT_GT(checked, 2500);
}

// On a face a point may come as near as it likes.
TEST_F(Triangles, AreSmoothUpToTheirFaces) {
  x << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0;
  for (const double height : {1e-3, 1e-9, 0.0, -1e-3}) {
    p = Vec3(0.3, 0.3, height);
    const auto H = triangleDistanceHessian(x, nearest(x, p), Vec3::UnitZ(), height);
    EXPECT_TRUE(H.allFinite());
    EXPECT_LT(H.norm(), 10.0);
    EXPECT_GT(H.norm(), 0.1);
  }
}

}  // namespace
}  // namespace palpate::contact::triangle_distance_test
