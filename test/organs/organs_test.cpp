// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/organs/organs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/mesh/size_check.h"
#include "palpate/mesh/surface_check.h"

namespace palpate::organs::organs_test {
namespace {

struct Expected {
  std::string name;
  Vec3 size;                      // [m]
  double min_volume, max_volume;  // [m^3], of adults
  double coarse, fine;            // edge lengths [m]
  int shells = 1;
};

const std::vector<Expected> kExpected = {
    {"liver", {0.22, 0.15, 0.10}, 1.1e-3, 1.7e-3, 0.015, 0.006},
    {"kidney", {0.11, 0.06, 0.045}, 1.1e-4, 1.8e-4, 0.010, 0.004},
    {"gallbladder", {0.09, 0.034, 0.034}, 3e-5, 5e-5, 0.006, 0.003},
    {"gallbladder_hollow", {0.09, 0.034, 0.034}, 1.2e-5, 2.5e-5, 0.005, 0.0025, 2},
    {"slab", {0.10, 0.10, 0.03}, 2.9999e-4, 3.0001e-4, 0.015, 0.005}};

std::vector<double> edgeLengths(const mesh::SurfaceMesh& surface) {
  std::vector<double> lengths;
  for (Eigen::Index c = 0; c < surface.triangles.size(); ++c) {
    const Eigen::Index t = c / 3;
    lengths.push_back((surface.points.col(surface.triangles(c % 3, t)) -
                       surface.points.col(surface.triangles((c + 1) % 3, t)))
                          .norm());
  }
  return lengths;
}

TEST(Organs, AreAllTestedHere) {
  std::vector<std::string> tested;
  for (const Expected& expected : kExpected) tested.push_back(expected.name);
  EXPECT_EQ(organNames(), tested);
}

TEST(Organs, AreSoundAtTwoResolutions) {
  for (const Expected& expected : kExpected) {
    for (const double edge : {expected.coarse, expected.fine}) {
      SCOPED_TRACE(expected.name + " " + std::to_string(edge));
      const mesh::SurfaceMesh surface = makeOrgan(expected.name, edge);
      const mesh::SurfaceReport report = mesh::checkSurface(surface);
      EXPECT_TRUE(report.ok());
      EXPECT_EQ(report.components, expected.shells);
      EXPECT_EQ(report.duplicate_points + report.isolated_points, 0);
      EXPECT_NO_THROW(mesh::checkSize(surface.points, "", ""));
    }
  }
}

TEST(Organs, HaveTheSizeOfAnAdults) {
  for (const Expected& expected : kExpected) {
    SCOPED_TRACE(expected.name);
    const mesh::SurfaceMesh surface = makeOrgan(expected.name, expected.fine);
    const Vec3 size = surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff();
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(size[k], expected.size[k], 0.05 * expected.size[k]);
    EXPECT_GT(mesh::enclosedVolume(surface), expected.min_volume);
    EXPECT_LT(mesh::enclosedVolume(surface), expected.max_volume);
  }
}

TEST(Organs, LieOnTheGroundAtTheOrigin) {
  for (const Expected& expected : kExpected) {
    SCOPED_TRACE(expected.name);
    const mesh::SurfaceMesh surface = makeOrgan(expected.name, expected.coarse);
    const Vec3 low = surface.points.rowwise().minCoeff(),
               high = surface.points.rowwise().maxCoeff();
    EXPECT_NEAR(low.z(), 0.0, 1e-12);
    EXPECT_NEAR(low.x() + high.x(), 0.0, 1e-12);
    EXPECT_NEAR(low.y() + high.y(), 0.0, 1e-12);
  }
}

TEST(Organs, HaveNearUniformTriangles) {
  for (const Expected& expected : kExpected) {
    for (const double edge : {expected.coarse, expected.fine}) {
      SCOPED_TRACE(expected.name + " " + std::to_string(edge));
      const std::vector<double> lengths = edgeLengths(makeOrgan(expected.name, edge));
      double mean = 0.0;
      for (const double length : lengths) mean += length / static_cast<double>(lengths.size());
      EXPECT_NEAR(mean, edge, 0.15 * edge);
      EXPECT_GT(*std::min_element(lengths.begin(), lengths.end()), 0.4 * edge);
      EXPECT_LT(*std::max_element(lengths.begin(), lengths.end()), 1.6 * edge);
    }
  }
}

TEST(Organs, AreTheSameBitsEachTime) {
  for (const Expected& expected : kExpected) {
    const mesh::SurfaceMesh a = makeOrgan(expected.name, expected.coarse);
    const mesh::SurfaceMesh b = makeOrgan(expected.name, expected.coarse);
    EXPECT_EQ(a.points, b.points) << expected.name;
    EXPECT_EQ(a.triangles, b.triangles) << expected.name;
  }
}

TEST(Organs, TheSurfaceConvergesWithTheEdgeLength) {
  for (const Expected& expected : kExpected) {
    const double coarse = mesh::enclosedVolume(makeOrgan(expected.name, expected.coarse));
    const double fine = mesh::enclosedVolume(makeOrgan(expected.name, expected.fine));
    EXPECT_NEAR(coarse, fine, 0.05 * fine) << expected.name;
  }
}

TEST(Organs, RefuseUnknownNamesWithTheNearest) {
  try {
    makeOrgan("livr", 0.01);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean liver?"), std::string::npos)
        << error.what();
  }
}

TEST(Organs, RefuseImpossibleEdgeLengths) {
  for (const std::string& name : organNames()) {
    for (const double edge : {0.0, -0.01, 1e-4, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
      EXPECT_THROW(makeOrgan(name, edge), InputError) << name << " " << edge;
    }
    EXPECT_NO_THROW(makeOrgan(name, maxOrganEdge(name)));
  }
}

}  // namespace
}  // namespace palpate::organs::organs_test
