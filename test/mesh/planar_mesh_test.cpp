// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/planar_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "palpate/mesh/surface_check.h"

namespace palpate::mesh::planar_mesh_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

Polygon box(double x, double y) {
  Polygon polygon(2, 4);
  polygon << 0, x, x, 0, 0, 0, y, y;
  return polygon;
}

struct Measured {
  double area = 0.0, mean_edge = 0.0, least_angle = 180.0;
  bool upward = true;
};

Measured measure(const SurfaceMesh& mesh) {
  Measured m;
  std::set<std::pair<int, int>> edges;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(k, t), b = mesh.triangles((k + 1) % 3, t),
                c = mesh.triangles((k + 2) % 3, t);
      edges.insert(std::minmax(a, b));
      const Vec3 p = mesh.points.col(b) - mesh.points.col(a),
                 q = mesh.points.col(c) - mesh.points.col(a);
      m.least_angle =
          std::min(m.least_angle, 180.0 / kPi * std::atan2(p.cross(q).norm(), p.dot(q)));
      if (k == 0) m.area += 0.5 * p.cross(q).z();
      m.upward = m.upward && p.cross(q).z() > 0.0;
    }
  }
  for (const auto& [a, b] : edges) m.mean_edge += (mesh.points.col(a) - mesh.points.col(b)).norm();
  m.mean_edge /= static_cast<double>(edges.size());
  return m;
}

TEST(PlanarMesh, FillsARectangle) {
  const SurfaceMesh mesh = meshPolygon(box(32, 24), {}, 2.0);
  const Measured m = measure(mesh);
  EXPECT_NEAR(m.area, 32 * 24, 1e-9 * 32 * 24);
  EXPECT_TRUE(m.upward);
  EXPECT_NEAR(m.mean_edge, 2.0, 0.4);
  EXPECT_GT(m.least_angle, 20.0);  // the criterion's
  const SurfaceReport report = checkSurface(mesh);
  EXPECT_TRUE(report.manifold);
  EXPECT_GE(report.boundary_edges, 2 * (16 + 12));
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.isolated_points, 0);
}

TEST(PlanarMesh, LeavesAHole) {
  const Polygon hole = circle({16, 12}, 6.0, 2.0);
  const SurfaceMesh mesh = meshPolygon(box(32, 24), {hole}, 2.0);
  const auto sides = static_cast<double>(hole.cols());
  const double hole_area = 0.5 * sides * 36.0 * std::sin(2 * kPi / sides);
  EXPECT_NEAR(measure(mesh).area, 32 * 24 - hole_area, 1e-9 * 32 * 24);
  EXPECT_TRUE(measure(mesh).upward);
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    EXPECT_GT((mesh.points.col(i) - Vec3(16, 12, 0)).norm(), 6.0 * std::cos(kPi / sides) - 1e-9);
  }
  const int vertices = static_cast<int>(mesh.points.cols()),
            boundary = checkSurface(mesh).boundary_edges;
  // N_t = 2 (N_v + N_h - 1) - N_b, one hole.
  EXPECT_EQ(mesh.triangles.cols(), 2 * vertices - boundary);
}

TEST(PlanarMesh, ClockwiseOutlinesAndTheSameBits) {
  const Polygon outline = circle({1, 2}, 0.7, 0.1);
  const SurfaceMesh mesh = meshPolygon(outline, {}, 0.1);
  const SurfaceMesh again = meshPolygon(outline, {}, 0.1);
  EXPECT_TRUE(mesh.points == again.points);
  EXPECT_TRUE(mesh.triangles == again.triangles);
  const SurfaceMesh turned = meshPolygon(outline.rowwise().reverse(), {}, 0.1);
  EXPECT_TRUE(measure(turned).upward);
  EXPECT_NEAR(measure(turned).area, measure(mesh).area, 1e-12);
}

TEST(PlanarMesh, RefusesWhatIsNoPolygon) {
  EXPECT_THROW(meshPolygon(Polygon::Zero(2, 2), {}, 1.0), std::invalid_argument);
  EXPECT_THROW(meshPolygon(Polygon::Zero(2, 5), {}, 1.0), std::invalid_argument);
  EXPECT_THROW(meshPolygon(box(1, 1), {}, 0.0), std::invalid_argument);
  EXPECT_THROW(meshPolygon(box(1, 1), {}, std::nan("")), std::invalid_argument);
  EXPECT_THROW(meshPolygon(box(1, 1), {}, 1e-5), std::invalid_argument);
  EXPECT_THROW(meshPolygon(box(1, 1), {circle({1, 1}, 0.3, 0.1)}, 0.1), std::invalid_argument);
  EXPECT_THROW(meshPolygon(box(2, 2), {box(1, 1)}, 0.1), std::invalid_argument);
  Polygon crossed(2, 4);
  crossed << 0, 3, 3, 0, 0, 1, 0, 2;
  EXPECT_THROW(meshPolygon(crossed, {}, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::mesh::planar_mesh_test
