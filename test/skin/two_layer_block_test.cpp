// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/two_layer_block.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "palpate/skin/limits.h"
#include "palpate/skin/profile_fit.h"
#include "support/input_error.h"

namespace palpate::skin::two_layer_block_test {
namespace {

using test::hasProblem;
using test::problemsOf;

TwoLayerBlock blockOf(int columns, int rows, int upper, double ratio) {
  TwoLayerBlock block;
  block.columns = columns;
  block.rows = rows;
  block.upper_rows = upper;
  block.stiffness_ratio = ratio;
  return block;
}

// Other code than ours, for the source's working mesh.
TEST(TwoLayerBlock, HasTheTopProfileOfUnitDepth) {
  const UnitIndentation unit = indent(TwoLayerBlock());
  const double left[] = {0, .03437, .09108, .17600, .28555, .41492, .55943, .72278, 1};
  for (int i = 0; i <= 8; ++i) {
    EXPECT_NEAR(unit.displacement(1, 7 * i), left[i], 0.5e-5) << i;
  }
  EXPECT_NEAR(unit.displacement(1, 7 * 12), 0.28812, 0.5e-5);  // x = 9 mm: no mirror of 0.28555
  EXPECT_NEAR(unit.displacement(0, 7 * 8), -0.04907, 0.5e-5);
  EXPECT_EQ(unit.mesh.points.cols(), 119);
  EXPECT_EQ(unit.mesh.triangles.size(), 2u * 96u);
  EXPECT_EQ(unit.band_width, 16);
  EXPECT_EQ(indent(blockOf(32, 12, 6, 10)).band_width, 28);
}

TEST(TwoLayerBlock, AlternatingDiagonalsAreSymmetric) {
  TwoLayerBlock block;
  block.diagonals = Diagonals::kAlternating;
  for (const int columns : {16, 14}) {
    block.columns = columns;
    const UnitIndentation unit = indent(block);
    for (int i = 0; i <= columns; ++i) {
      for (int j = 0; j <= 6; ++j) {
        const auto here = unit.displacement.col(7 * i + j);
        const auto there = unit.displacement.col(7 * (columns - i) + j);
        EXPECT_NEAR(here.x(), -there.x(), 1e-12);
        EXPECT_NEAR(here.y(), there.y(), 1e-12);
      }
    }
  }
}

// The source's example: eight nodes a row and four a column, squares with both far corners joined.
TEST(TwoLayerBlock, TheBandIsNarrowWhereNumbersRunTheShortWay) {
  TwoLayerBlock block = blockOf(8, 3, 1, 1);
  block.diagonals = Diagonals::kAlternating;
  block.columns = 8;
  PlaneMesh mesh;
  const auto example = [&](int across, int down) {  // step of a number to the right, downwards
    mesh = PlaneMesh();
    mesh.points.resize(2, 32);
    for (int i = 0; i < 7; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int a = across * i + down * j;
        mesh.triangles.push_back({a, a + across, a + across + down});
        mesh.triangles.push_back({a, a + across + down, a + down});
      }
    }
    return bandWidth(mesh);
  };
  EXPECT_EQ(example(1, 8), 20);
  EXPECT_EQ(example(4, 1), 12);
  const int columns = bandWidth(blockMesh(block));
  block.numbering = Numbering::kRows;
  EXPECT_EQ(columns, 2 * (4 + 1 + 1));
  EXPECT_EQ(bandWidth(blockMesh(block)), 2 * (9 + 1 + 1));
}

TEST(TwoLayerBlock, NumberingDoesNotMatter) {
  TwoLayerBlock block;
  const UnitIndentation columns = indent(block);
  block.numbering = Numbering::kRows;
  const UnitIndentation rows = indent(block);
  EXPECT_NEAR(columns.force, rows.force, 1e-10 * columns.force);
  EXPECT_NEAR(columns.displacement(1, 7 * 5 + 2), rows.displacement(1, 17 * 2 + 5), 1e-12);
}

// Loading by displacement: constants of one factor leave the shape and scale the force.
TEST(TwoLayerBlock, OnlyTheForceKnowsTheModulus) {
  TwoLayerBlock block;
  const UnitIndentation published = indent(block);
  block.idealization = Idealization::kPlaneStress;
  const UnitIndentation right = indent(block);
  block.young_modulus *= 3.0;
  block.slab *= 2.0;
  const UnitIndentation stiff = indent(block);
  EXPECT_LT((published.displacement - stiff.displacement).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_NEAR(right.force / published.force, 1.2304 / 0.7696, 1e-10);
  EXPECT_NEAR(stiff.force / right.force, 6.0, 1e-10);
  EXPECT_GT(published.force, 0.0);
}

// Work done by the contact is the energy: f d/2 = u K u/2, by differences of the depth too.
TEST(TwoLayerBlock, TheForceDoesTheWork) {
  for (const Idealization kind : {Idealization::kPlaneStrain, Idealization::kAxisymmetric}) {
    TwoLayerBlock block;
    block.idealization = kind;
    block.patch = 0.0015;
    const UnitIndentation unit = indent(block);
    double energy = 0.0;  // twice
    const auto upper = elasticityMatrix(kind, block.young_modulus, block.poisson_ratio);
    for (std::size_t t = 0; t < unit.mesh.triangles.size(); ++t) {
      Eigen::Matrix<double, 6, 1> u;
      for (int i = 0; i < 3; ++i) {
        u.segment<2>(2 * i) =
            unit.displacement.col(unit.mesh.triangles[t][static_cast<std::size_t>(i)]);
      }
      const double share = unit.mesh.materials[t] == 0 ? 1.0 : 1.0 / block.stiffness_ratio;
      energy += u.dot(triangleStiffness(unit.mesh.corners(t), share * upper, kind, block.slab) * u);
    }
    EXPECT_NEAR(unit.force, energy, 1e-9 * energy) << toString(kind);
  }
}

// A depth of exactly -1 was a mark for "free" in the source's code.
TEST(TwoLayerBlock, ADepthOfOneMillimetreUpOrDownIsADepth) {
  const UnitIndentation unit = indent(TwoLayerBlock());
  for (const double depth : {1e-3, -1e-3}) {
    for (const int i : {4, 8}) {  // columns: where the node has gone, the surface is as deep
      const auto moved = unit.displacement.col(7 * i);
      const double radius = 0.006 - (0.00075 * i + depth * moved.x());
      EXPECT_NEAR(surfaceDepth(unit, depth, radius), depth * moved.y(), 1e-15);
    }
    EXPECT_EQ(unit.displacement(1, 7 * 8), 1.0);
  }
  EXPECT_EQ(surfaceDepth(unit, 0.0, 0.003), 0.0);
}

// Between all of the lower layer's stiffness and all of the upper one's.
TEST(TwoLayerBlock, StiffnessIsBetweenBounds) {
  TwoLayerBlock block = blockOf(16, 6, 3, 10.0);
  block.idealization = Idealization::kPlaneStress;
  const double layered = indent(block).force;
  block.stiffness_ratio = 1.0;
  const double hard = indent(block).force;
  block.young_modulus /= 10.0;
  const double soft = indent(block).force;
  EXPECT_GT(layered, soft);
  EXPECT_LT(layered, hard);
  EXPECT_NEAR(hard, 10.0 * soft, 1e-9 * hard);
}

TEST(TwoLayerBlock, APatchGoesDownWhole) {
  TwoLayerBlock block;
  block.patch = 0.0015;
  block.slides = false;
  const UnitIndentation unit = indent(block);
  for (int i = 6; i <= 10; ++i) EXPECT_EQ(unit.displacement.col(7 * i), Eigen::Vector2d(0, 1));
  EXPECT_LT(unit.displacement(1, 7 * 5), 0.9);
  EXPECT_GT(unit.force, indent(TwoLayerBlock()).force);
}

// For inversions it went in steps of 0.01 mm and gave the first depth beyond.
TEST(Limits, AreThoseFoundByOtherCode) {
  const auto firstStep = [](double depth) { return std::ceil(depth / 1e-5) * 1e-2; };
  const UnitIndentation coarse = indent(TwoLayerBlock()), fine = indent(blockOf(32, 12, 6, 10));
  EXPECT_NEAR(firstStep(inversionDepth(coarse)), 2.80, 1e-9);
  EXPECT_NEAR(firstStep(inversionDepth(fine)), 2.60, 1e-9);
  EXPECT_NEAR(1e3 * boneDepth(coarse), 3.16, 0.005);
  EXPECT_NEAR(1e3 * boneDepth(fine), 3.46, 0.005);
  EXPECT_NEAR(1e3 * boneDepth(indent(blockOf(16, 6, 5, 31))), 1.38, 0.005);
}

TEST(Limits, TheFirstTriangleHasNoAreaThere) {
  for (const bool slides : {true, false}) {
    TwoLayerBlock block;
    block.slides = slides;
    const UnitIndentation unit = indent(block);
    const double depth = inversionDepth(unit);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < unit.mesh.triangles.size(); ++t) {
      Corners moved = unit.mesh.corners(t);
      for (int i = 0; i < 3; ++i) {
        moved.col(i) +=
            depth * unit.displacement.col(unit.mesh.triangles[t][static_cast<std::size_t>(i)]);
      }
      least = std::min(least, signedArea(moved) / signedArea(unit.mesh.corners(t)));
    }
    EXPECT_NEAR(least, 0.0, 1e-12);
  }
}

TEST(TwoLayerBlock, RefusesAnInterfaceInsideAnElement) {
  EXPECT_EQ(upperRows(0.5, 6), 3);
  EXPECT_EQ(upperRows(1.0 / 3.0, 12), 4);
  EXPECT_EQ(upperRows(0.833333, 6), 5);
  EXPECT_TRUE(hasProblem(problemsOf([] { upperRows(0.4, 6); }), "fraction", "inside an element"));
  EXPECT_TRUE(hasProblem(problemsOf([] { upperRows(0.5, 3); }), "fraction", "multiple of 1/3"));
  EXPECT_TRUE(hasProblem(problemsOf([] { upperRows(0.0, 6); }), "fraction", "either layer"));
  EXPECT_TRUE(hasProblem(problemsOf([] { upperRows(1.0, 6); }), "fraction", "either layer"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(upperRows(nan, 6), InputError);
}

TEST(TwoLayerBlock, RefusesWhatIsNoBlock) {
  const auto refused = [](const char* key, const char* part, auto&& change) {
    TwoLayerBlock block;
    change(block);
    EXPECT_TRUE(hasProblem(problemsOf([&] { checkBlock(block); }), key, part));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused("columns", "even", [](auto& b) { b.columns = 15; });
  refused("columns", "2 million", [](auto& b) { b.columns = 2000000; });
  refused("rows", ">= 2", [](auto& b) { b.rows = 1; });
  refused("upper_rows", "in [1", [](auto& b) { b.upper_rows = 6; });
  refused("width", "> 0", [](auto& b) { b.width = 0.0; });
  refused("height", "> 0", [&](auto& b) { b.height = nan; });
  refused("young_modulus", "> 0", [](auto& b) { b.young_modulus = -1.0; });
  refused("stiffness_ratio", "> 0", [](auto& b) { b.stiffness_ratio = 0.0; });
  refused("slab", "> 0", [](auto& b) { b.slab = 0.0; });
  refused("poisson_ratio", "0.5", [](auto& b) { b.poisson_ratio = 0.5; });
  refused("patch", "at a node", [](auto& b) { b.patch = 0.001; });
  refused("patch", "held sides", [](auto& b) { b.patch = 0.006; });
  refused("patch", ">= 0", [&](auto& b) { b.patch = nan; });
}

}  // namespace
}  // namespace palpate::skin::two_layer_block_test
