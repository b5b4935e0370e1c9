// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "palpate/mesh/selection.h"
#include "support/contains.h"

namespace palpate::mesh::tet_selection_test {
namespace {

// A cube [0, 1]^3 of 8^3 cells: 3072 tetrahedra of equal volume.
class TetSelection : public ::testing::Test {
 protected:
  TetMesh mesh = boxMesh(Vec3::Ones(), Eigen::Vector3i(8, 8, 8));

  double part(const TetRegion& region) const {
    return static_cast<double>(selectTets(mesh, region).size()) /
           static_cast<double>(mesh.numTets());
  }
  std::string refusal(const TetRegion& region) const {
    try {
      selectTets(mesh, region);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(TetSelection, BoxByCentroid) {
  // Whole cells: the centroids lie inside them, although corners lie on the box.
  EXPECT_EQ(part(BoxRegion{Vec3::Zero(), Vec3(0.5, 1, 1)}), 0.5);
  EXPECT_EQ(part(BoxRegion{Vec3(0.25, 0.25, 0.25), Vec3(0.75, 0.75, 0.75)}), 0.125);
}

TEST_F(TetSelection, SphereHasAboutItsVolume) {
  const double volume = 4.0 / 3.0 * M_PI * 0.064;
  EXPECT_NEAR(part(SphereRegion{Vec3(0.5, 0.5, 0.5), 0.4}), volume, 0.05 * volume);
}

TEST_F(TetSelection, HalfSpaceBesidePlane) {
  EXPECT_EQ(part(HalfSpaceRegion{Vec3(0.25, 0, 0), Vec3(5, 0, 0)}), 0.75);
  EXPECT_EQ(part(HalfSpaceRegion{Vec3(0.25, 0, 0), Vec3(-1, 0, 0)}), 0.25);
}

TEST_F(TetSelection, DepthIsTheDistanceFromTheNearestFace) {
  const Points centroids = tetCentroids(mesh);
  const Eigen::VectorXd depth = surfaceDistances(mesh, centroids);
  for (Eigen::Index i = 0; i < mesh.numTets(); ++i) {
    const Vec3 c = centroids.col(i);
    ASSERT_NEAR(depth[i], std::min(c.minCoeff(), (Vec3::Ones() - c).minCoeff()), 1e-14);
  }
  // One cell deep: all but 6^3 of 8^3 cells.
  EXPECT_EQ(part(DepthRegion{0.0, 0.125}), 1.0 - 216.0 / 512.0);
  EXPECT_EQ(part(DepthRegion{0.125}), 216.0 / 512.0);
}

TEST_F(TetSelection, TagsAreTheDefault) {
  mesh.region.assign(static_cast<std::size_t>(mesh.numTets()), 3);
  mesh.region[7] = 4;
  EXPECT_EQ(selectTets(mesh, CellDataRegion{"", 4}), std::vector<int>{7});
  EXPECT_EQ(selectTets(mesh, CellDataRegion{"region", 4}), std::vector<int>{7});
  EXPECT_TRUE(selectTets(mesh, CellDataRegion{"", 5}).empty());
}

TEST_F(TetSelection, CellDataByName) {
  mesh.cell_data["tissue"] = Eigen::MatrixXd::Ones(1, mesh.numTets());
  mesh.cell_data["tissue"](0, 9) = -2.0;
  EXPECT_EQ(selectTets(mesh, CellDataRegion{"tissue", -2}), std::vector<int>{9});
}

TEST_F(TetSelection, RefusesDataThatIsNotThere) {
  EXPECT_TRUE(test::contains(refusal(CellDataRegion{"", 1}), "no region tags"));
  EXPECT_TRUE(test::contains(refusal(CellDataRegion{"tissue", 1}), "it has none"));
  mesh.cell_data["fibres"] = Eigen::MatrixXd::Ones(3, mesh.numTets());
  mesh.cell_data["heat"] = Eigen::MatrixXd::Constant(1, mesh.numTets(), 0.5);
  mesh.cell_data["holes"] = Eigen::MatrixXd::Constant(1, mesh.numTets(), std::nan(""));
  EXPECT_TRUE(test::contains(refusal(CellDataRegion{"tissue", 1}), "it has fibres, heat, holes"));
  for (const char* name : {"fibres", "heat", "holes"}) {
    EXPECT_TRUE(test::contains(refusal(CellDataRegion{name, 1}), "one whole number")) << name;
  }
}

}  // namespace
}  // namespace palpate::mesh::tet_selection_test
