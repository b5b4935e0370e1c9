// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of 10-node tetrahedra: made from 4-node ones, their faces, and places in bent ones.
#include <gtest/gtest.h>

#include <set>

#include "palpate/mesh/point_location.h"
#include "palpate/mesh/tet_mesh.h"
#include "support/random.h"

namespace palpate::mesh::quadratic_mesh_test {
namespace {

const TetMesh kLinear = boxMesh(Vec3(1.0, 2.0, 1.5), Eigen::Vector3i(2, 3, 2));
const TetMesh kQuadratic = toQuadratic(kLinear);

TEST(ToQuadratic, PutsOneNodeInTheMiddleOfEachEdge) {
  std::set<std::pair<int, int>> edges;
  constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  for (Eigen::Index e = 0; e < kLinear.numTets(); ++e) {
    for (int k = 0; k < 6; ++k) {
      const int a = kLinear.tets(kEdges[k][0], e), b = kLinear.tets(kEdges[k][1], e);
      edges.insert(std::minmax(a, b));
      EXPECT_EQ(Vec3(kQuadratic.points.col(kQuadratic.midnodes(k, e))),
                Vec3(0.5 * (kLinear.points.col(a) + kLinear.points.col(b))));
    }
  }
  EXPECT_EQ(kQuadratic.numPoints(), kLinear.numPoints() + static_cast<Eigen::Index>(edges.size()));
  EXPECT_EQ(kQuadratic.points.leftCols(kLinear.numPoints()), kLinear.points);
  EXPECT_EQ(toQuadratic(kQuadratic).numPoints(), kQuadratic.numPoints());
}

double signedVolumeUnder(const Points& points, const Eigen::Matrix3Xi& triangles) {
  double volume = 0.0;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Vec3 a = points.col(triangles(0, t)), b = points.col(triangles(1, t));
    volume += a.dot(b.cross(Vec3(points.col(triangles(2, t))))) / 6.0;
  }
  return volume;
}

TEST(BoundaryFaces, CloseTheBodyAndPointOutward) {
  const Eigen::MatrixXi faces = boundaryFaces(kQuadratic);
  ASSERT_EQ(faces.rows(), 6);
  EXPECT_EQ(faces.topRows(3), boundaryFaces(kLinear));
  EXPECT_EQ(trianglesOf(faces).cols(), 4 * faces.cols());
  EXPECT_NEAR(signedVolumeUnder(kQuadratic.points, trianglesOf(faces)), 3.0, 1e-13);
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 middle =
          0.5 * (kQuadratic.points.col(faces(k, f)) + kQuadratic.points.col(faces((k + 1) % 3, f)));
      EXPECT_EQ(Vec3(kQuadratic.points.col(faces(3 + k, f))), middle);
    }
  }
}

TEST(Locate, FindsThePlaceAndInterpolatesThere) {
  test::Random random;
  TetMesh bent = kQuadratic;
  bent.points.rightCols(bent.numPoints() - kLinear.numPoints()) +=
      random.points(bent.numPoints() - kLinear.numPoints(), 0.03);
  for (const TetMesh& mesh : {kLinear, kQuadratic, bent}) {
    for (int trial = 0; trial < 30; ++trial) {
      const Vec3 p = Vec3(0.5, 1.0, 0.75) + random.vector(0.4);
      const auto at = locate(mesh, p);
      ASSERT_TRUE(at.has_value());
      EXPECT_NEAR(at->w.sum(), 1.0, 1e-12);
      EXPECT_LT((interpolate(mesh, *at, mesh.points) - p).norm(), 1e-12);
      EXPECT_LT((interpolate(mesh, *at, 2.0 * mesh.points) - 2.0 * p).norm(), 1e-12);
    }
    EXPECT_FALSE(locate(mesh, Vec3(3.0, 1.0, 0.5)).has_value());
  }
}

TEST(Locate, QuadraticShapesInterpolateASquare) {
  Points square = kQuadratic.points;
  square.row(0) = kQuadratic.points.row(0).cwiseProduct(kQuadratic.points.row(1));
  const Vec3 p(0.31, 1.47, 0.66);
  EXPECT_NEAR(interpolate(kQuadratic, *locate(kQuadratic, p), square).x(), 0.31 * 1.47, 1e-13);
}

}  // namespace
}  // namespace palpate::mesh::quadratic_mesh_test
