// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/instrument/mesh_shape.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "palpate/contact/signed_distance.h"
#include "palpate/instrument/convex_hull.h"
#include "palpate/instrument/instrument.h"
#include "palpate/mesh/convex_hull.h"
#include "support/concave_surfaces.h"
#include "support/contains.h"
#include "support/temp_folder.h"
#include "urdf_text.h"

namespace palpate::instrument::mesh_shape_test {
namespace {

using test::contains;

mesh::SurfaceMesh block(const Vec3& size, const Eigen::Vector3i& cubes) {
  return test::carved(size, cubes, [](const Vec3&) { return true; });
}

mesh::SurfaceMesh both(const mesh::SurfaceMesh& a, const mesh::SurfaceMesh& b) {
  mesh::SurfaceMesh all;
  all.points.resize(3, a.points.cols() + b.points.cols());
  all.points << a.points, b.points;
  all.triangles.resize(3, a.triangles.cols() + b.triangles.cols());
  all.triangles << a.triangles, (b.triangles.array() + static_cast<int>(a.points.cols())).matrix();
  return all;
}

std::string refusal(const mesh::SurfaceMesh& surface) {
  try {
    shapeOfMesh(surface, "tool.stl", {});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string objOf(const mesh::SurfaceMesh& surface) {
  std::ostringstream text;
  text.precision(17);
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
    text << "v " << surface.points.col(i).transpose() << "\n";
  }
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    text << "f " << (surface.triangles.col(t).array() + 1).transpose() << "\n";
  }
  return text.str();
}

TEST(MeshShape, ConvexMeshesAreTheirHull) {
  mesh::SurfaceMesh box = block(Vec3(0.01, 0.02, 0.03), Eigen::Vector3i(2, 2, 2));
  EXPECT_TRUE(std::holds_alternative<ConvexHull>(shapeOfMesh(box, "", {}).geometry));
  // Pushed in by less than a thousandth of the diagonal of 37 mm, and by more.
  for (Eigen::Index i = 0; i < box.points.cols(); ++i) {
    if ((box.points.col(i) - Vec3(0.005, 0.010, 0.030)).norm() > 1e-9) continue;
    box.points(2, i) -= 0.03e-3;
    EXPECT_TRUE(std::holds_alternative<ConvexHull>(shapeOfMesh(box, "", {}).geometry));
    box.points(2, i) -= 0.03e-3;
    EXPECT_TRUE(std::holds_alternative<SampledSurface>(shapeOfMesh(box, "", {}).geometry));
  }
}

// The notch goes through the whole U, so that all corners of its mesh are on the hull.
TEST(MeshShape, DepthBelowTheHullIsFoundBetweenTheCorners) {
  const mesh::SurfaceMesh u = test::uSurface();
  const ConvexHull hull = makeConvexHull(mesh::convexHull(u.points));
  EXPECT_LT(
      (hull.offsets.rowwise().replicate(u.points.cols()) - hull.normals.transpose() * u.points)
          .colwise()
          .minCoeff()
          .maxCoeff(),
      1e-12);
  EXPECT_NEAR(depthBelowHull(u, hull), 0.0025, 0.0002);  // half as thick as it is
}

TEST(MeshShape, OthersAreSampledAndTheNoteSaysHow) {
  const MeshShape shape = shapeOfMesh(test::uSurface(), "u.obj", {});
  const auto& u = std::get<SampledSurface>(shape.geometry);
  EXPECT_TRUE(shape.repairs.empty());
  EXPECT_TRUE(contains(shape.note, "not convex: its distance is sampled"));
  const Eigen::Vector3i& cells = u.grid->field.box.cells;
  EXPECT_TRUE(contains(shape.note, std::to_string(cells.x()) + " x " + std::to_string(cells.y()) +
                                       " x " + std::to_string(cells.z()) + " cells of 0.34 mm"));
  EXPECT_TRUE(contains(shape.note, "at most near the surface, rms"));
  EXPECT_FALSE(contains(shape.note, "is full"));
  EXPECT_LE(u.grid->largest_error, MeshShapeSettings().error);

  MeshShapeSettings settings;
  settings.error = 1e-6;
  settings.memory = 1.0;
  EXPECT_TRUE(contains(shapeOfMesh(test::uSurface(), "u.obj", settings).note,
                       "the memory that is allowed, 1 MB, is full"));
  settings.convex_hull = true;
  const MeshShape filled = shapeOfMesh(test::uSurface(), "u.obj", settings);
  EXPECT_TRUE(std::holds_alternative<ConvexHull>(filled.geometry));
  EXPECT_TRUE(contains(filled.note, "filled up to its convex hull"));
}

TEST(MeshShape, SmallHolesAreClosedAndLargeOnesRefused) {
  mesh::SurfaceMesh u = test::uSurface();
  const mesh::SurfaceMesh whole = u;
  // Of a finer one, so that a triangle is a small hole.
  mesh::SurfaceMesh fine = test::carved(Vec3(0.02, 0.02, 0.02), Eigen::Vector3i(8, 8, 8),
                                        [](const Vec3& p) { return p.x() < 0.01 || p.z() < 0.01; });
  fine.triangles.conservativeResize(3, fine.triangles.cols() - 1);
  const MeshShape closed = shapeOfMesh(fine, "l.obj", {});
  EXPECT_TRUE(std::holds_alternative<SampledSurface>(closed.geometry));
  ASSERT_EQ(closed.repairs.size(), 1u);
  EXPECT_TRUE(contains(closed.repairs[0], "filled 1 hole"));

  u.triangles.conservativeResize(3, u.triangles.cols() - 6);
  const std::string open = refusal(u);
  EXPECT_TRUE(contains(open, "it is not convex, and its inside is not known"));
  EXPECT_TRUE(contains(open, "tool.stl")) << open;
  EXPECT_TRUE(contains(open, "the surface is open"));
  EXPECT_TRUE(contains(open, "convex_hull: true"));
  mesh::SurfaceMesh crossing = whole;
  crossing.points.colwise() += Vec3(0.0021, 0.0013, 0.0017);
  EXPECT_TRUE(contains(refusal(both(whole, crossing)), "the surface cuts itself"));
}

TEST(MeshShape, OfAnInstrumentIsNotedWithItsLink) {
  const test::TempFolder temp;
  temp.write("u.obj", objOf(test::uSurface()));
  // Mirrored, the triangles would face inwards.
  const std::string file = temp.write(
      "a.urdf", robot(link("tip", collision("<mesh filename=\"u.obj\" scale=\"1 1 -1\"/>"))));
  int calls = 0;
  InstrumentOptions options;
  options.progress = [&](const std::string& what, double) {
    EXPECT_TRUE(contains(what, "collision mesh of tip: "));
    ++calls;
  };
  const Instrument instrument = readInstrument(file, options);
  EXPECT_GT(calls, 0);
  ASSERT_EQ(instrument.notes().size(), 1u);
  EXPECT_TRUE(contains(instrument.notes()[0], "collision mesh of tip: not convex"));
  EXPECT_TRUE(instrument.warnings().empty());
  const Geometry& u = instrument.bodies()[0].geometry;
  EXPECT_LT(contact::signedDistanceValue(u, Vec3(0.0075, 0.0025, -0.0025)), -0.002);
  EXPECT_GT(contact::signedDistanceValue(u, Vec3(0.0075, 0.0025, -0.0100)), 0.002);
  options.collision_meshes.convex_hull = true;
  EXPECT_TRUE(
      std::holds_alternative<ConvexHull>(readInstrument(file, options).bodies()[0].geometry));
}

}  // namespace
}  // namespace palpate::instrument::mesh_shape_test
