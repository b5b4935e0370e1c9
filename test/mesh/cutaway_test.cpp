// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that a box is taken out of: closed, of the right volume, coloured by what they are of.
#include "palpate/mesh/cutaway.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "crooked_block.h"

namespace palpate::mesh::cutaway_test {
namespace {

const double kInf = std::numeric_limits<double>::infinity();
const Vec3 kSize(0.12, 0.1, 0.06);

CutBox beyond(const Vec3& low) { return {low, Vec3::Constant(kInf)}; }

struct Integrals {
  Vec3 area = Vec3::Zero();  // of all triangles, as vectors [m^2]
  double volume = 0.0;       // [m^3]
};

Integrals integrate(const Cutaway& cut, const Points& x) {
  Points p;
  cut.interpolate(x, &p);
  Integrals all;
  for (Eigen::Index m = 0; m < cut.numTriangles(); ++m) {
    const Vec3 a = p.col(3 * m), b = p.col(3 * m + 1), c = p.col(3 * m + 2);
    all.area += 0.5 * (b - a).cross(c - a);
    all.volume += a.dot(b.cross(c)) / 6.0;
  }
  return all;
}

double areaOfCuts(const Cutaway& cut, const Points& x, int solid = -1) {
  Points p;
  cut.interpolate(x, &p);
  double sum = 0.0;
  for (Eigen::Index m = cut.num_outer; m < cut.numTriangles(); ++m) {
    if (solid >= 0 && cut.solid[static_cast<std::size_t>(m)] != solid) continue;
    const Vec3 a = p.col(3 * m);
    sum += 0.5 * (p.col(3 * m + 1) - a).cross(p.col(3 * m + 2) - a).norm();
  }
  return sum;
}

CellMesh gridBlock() { return cellsOf(boxMesh(kSize, {6, 5, 3})); }

// Four boxes: along planes of the grid, between them, a quarter that ends, one amid the body.
std::vector<CutBox> boxes() {
  return {beyond({0.06, 0.04, -kInf}),
          beyond({0.053, 0.037, -kInf}),
          {Vec3(0.053, -kInf, 0.021), Vec3(kInf, 0.071, kInf)},
          {Vec3(0.031, 0.033, 0.017), Vec3(0.089, 0.071, 0.043)}};
}

double volumeIn(const CutBox& box) {
  return (box.high.cwiseMin(kSize) - box.low.cwiseMax(0.0)).prod();
}

TEST(Cutaway, IsClosedAndHasTheVolumeThatIsLeft) {
  const CellMesh body = gridBlock();
  for (const CutBox& box : boxes()) {
    const Cutaway cut = cutAway(body, box);
    const Integrals all = integrate(cut, body.points);
    EXPECT_LT(all.area.norm(), 1e-15);
    EXPECT_NEAR(all.volume, kSize.prod() - volumeIn(box), 1e-12 * kSize.prod());
    Points p;
    cut.interpolate(body.points, &p);
    for (Eigen::Index v = 3 * cut.num_outer; v < p.cols(); ++v) {
      const double off = ((p.col(v) - box.low).cwiseAbs().minCoeff());
      EXPECT_LT(std::min(off, (p.col(v) - box.high).cwiseAbs().minCoeff()), 1e-12);
    }
  }
}

// Each vertex is a point of the material: what bends the body opens no gap.
TEST(Cutaway, StaysClosedHoweverTheBodyDeforms) {
  const CellMesh body = cellsOf(test::crookedBlock());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  for (const CutBox& box : boxes()) {
    const Cutaway cut = cutAway(body, box);
    const Points straight = test::linearField(body.points);
    Mat3 A;
    A << 1.0, 0.2, -0.3, 0.1, 0.8, 0.4, 0.0, -0.5, 1.3;
    EXPECT_NEAR(integrate(cut, straight).volume,
                A.determinant() * integrate(cut, body.points).volume, 1e-12 * kSize.prod());
    Points x = body.points;
    for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] += shift(random);
    EXPECT_LT(integrate(cut, x).area.norm(), 1e-15);
  }
}

TEST(Cutaway, TheTwoSidesOfAPlaneMakeTheWhole) {
  const CellMesh body = cellsOf(test::crookedBlock());
  const double whole = test::volumeOf(test::crookedBlock());
  for (int axis = 0; axis < 3; ++axis) {
    CutBox one, other;
    one.low[axis] = other.high[axis] = 0.47 * kSize[axis];
    const Cutaway a = cutAway(body, one), b = cutAway(body, other);
    EXPECT_NEAR(integrate(a, body.points).volume + integrate(b, body.points).volume, whole,
                1e-12 * whole);
    EXPECT_NEAR(areaOfCuts(a, body.points), areaOfCuts(b, body.points), 1e-15);
  }
}

// Along planes of the grid a cut has the tetrahedra's own sides: two a square.
TEST(Cutaway, HasAsManyTrianglesAsTheGridSays) {
  const CellMesh body = gridBlock();
  const Cutaway cut = cutAway(body, beyond({0.06, 0.04, -kInf}));
  EXPECT_EQ(cut.numTriangles() - cut.num_outer, 2 * (3 * 3 + 3 * 3));
  // Top and bottom lose 3 x 3 squares each, two sides 3 x 3.
  EXPECT_EQ(cut.num_outer, 2 * (2 * (30 - 9) + 2 * 15 + 2 * 18 - 9 - 9));
  EXPECT_EQ(cut.bared.size(), static_cast<std::size_t>(4 * 4 * 4));
  for (const int i : cut.bared) {
    EXPECT_GE(body.points(0, i), 0.06 - 1e-12);
    EXPECT_GE(body.points(1, i), 0.04 - 1e-12);
  }
}

TEST(Cutaway, CutsHaveTheSolidsOfTheirCells) {
  CellMesh body = gridBlock();
  for (Eigen::Index c = 0; c < body.numCells(); ++c) {
    double z = 0.0;
    for (int k = 0; k < 4; ++k) z += 0.25 * body.points(2, body.cells(k, c));
    body.solid.push_back(z > 0.02 ? 1 : 0);  // of three layers the upper two
  }
  const Cutaway cut = cutAway(body, beyond({0.053, 0.037, -kInf}));
  const double width = (0.12 - 0.053) + (0.1 - 0.037);
  EXPECT_NEAR(areaOfCuts(cut, body.points, 0), width * 0.02, 1e-15);
  EXPECT_NEAR(areaOfCuts(cut, body.points, 1), width * 0.04, 1e-15);
}

TEST(Cutaway, HexahedraAndQuadraticTetrahedraAreCutAlike) {
  const CutBox box = beyond({0.053, 0.037, 0.011});
  const double left = kSize.prod() - volumeIn(box);
  const CellMesh quadratic = cellsOf(toQuadratic(boxMesh(kSize, {3, 2, 2})));
  ASSERT_EQ(quadratic.cells.rows(), 10);
  const Cutaway cut = cutAway(quadratic, box);
  EXPECT_NEAR(integrate(cut, quadratic.points).volume, left, 1e-12 * left);
  EXPECT_LT(integrate(cut, quadratic.points).area.norm(), 1e-15);

  CellMesh hexahedra;  // 2 x 1 x 1
  hexahedra.points.resize(3, 12);
  hexahedra.cells.resize(8, 2);
  for (int i = 0; i < 12; ++i) {
    hexahedra.points.col(i) = Vec3(i % 3 * 0.5, i / 3 % 2, i / 6).cwiseProduct(kSize);
  }
  hexahedra.cells.col(0) << 0, 1, 4, 3, 6, 7, 10, 9;
  hexahedra.cells.col(1) << 1, 2, 5, 4, 7, 8, 11, 10;
  const Cutaway of_hexahedra = cutAway(hexahedra, box);
  EXPECT_NEAR(integrate(of_hexahedra, hexahedra.points).volume, left, 1e-12 * left);
  EXPECT_NEAR(areaOfCuts(of_hexahedra, hexahedra.points), areaOfCuts(cut, quadratic.points), 1e-15);
}

TEST(Cutaway, OfASurfaceIsWhatIsOutside) {
  CellMesh sheet;
  sheet.points.resize(3, 4);
  sheet.points << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  sheet.cells.resize(3, 2);
  sheet.cells << 0, 0, 1, 2, 2, 3;
  const Cutaway cut = cutAway(sheet, beyond({0.3, 0.6, -kInf}));
  EXPECT_EQ(cut.num_outer, cut.numTriangles());
  EXPECT_NEAR(integrate(cut, sheet.points).area.z(), 1.0 - 0.7 * 0.4, 1e-15);
}

TEST(Cutaway, NothingOrEverythingIsCutAway) {
  const CellMesh body = gridBlock();
  // Beside the body, and along its top.
  for (const CutBox& box : {beyond({0.2, -kInf, -kInf}), beyond({-kInf, -kInf, kSize.z()})}) {
    const Cutaway cut = cutAway(body, box);
    EXPECT_EQ(cut.numTriangles(), cut.num_outer);
    EXPECT_NEAR(integrate(cut, body.points).volume, kSize.prod(), 1e-12 * kSize.prod());
  }
  for (const CutBox& box : {CutBox(), beyond({-kInf, -kInf, 0.0})}) {
    const Cutaway none = cutAway(body, box);
    EXPECT_EQ(none.numTriangles(), 0);
    EXPECT_EQ(none.bared.size(), static_cast<std::size_t>(body.numPoints()));
  }
  EXPECT_EQ(cutAway(CellMesh(), CutBox()).numTriangles(), 0);
  EXPECT_THROW(cutAway(body, {Vec3::Ones(), Vec3::Ones()}), std::invalid_argument);
  EXPECT_THROW(cutAway(body, beyond({std::nan(""), 0.0, 0.0})), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::mesh::cutaway_test
