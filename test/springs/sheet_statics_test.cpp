// SPDX-License-Identifier: GPL-3.0-or-later
// Regular sheets at rest: what their free edges do, and clamped discs.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "palpate/springs/network_modes.h"
#include "palpate/springs/network_statics.h"
#include "palpate/springs/spring_grids.h"

namespace palpate::springs::sheet_statics_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Where a free sheet comes to rest in its plane; `pinned` stays, `guided` may move along x only.
Points atRest(const SpringNetwork& sheet, Eigen::Index pinned, Eigen::Index guided,
              double imbalance) {
  NetworkLoads loads = noLoads(sheet);
  loads.free.row(2).setZero();
  loads.free.col(pinned).setZero();
  loads.free(1, guided) = 0.0;
  Points x = sheet.points;
  EXPECT_EQ(solveNetwork(sheet, loads, {imbalance}, &x).status, solver::SolveStatus::kConverged);
  return x;
}

// 21 x 21 masses with the springs of chapter 4, as [Wang 2005, 4.3.4]; the figures are those of the
// same sheet computed by another program.
TEST(SheetStatics, OnlyTheOutermostSpringsOfAPreloadedSheetDeform) {
  constexpr int n = 21, middle = 10;
  const double U = 1.0;
  const Sheet thin{1.0e6, 0.3, 0.01};
  const TriangleSprings springs = bendingTriangleSprings(thin, U);
  EXPECT_NEAR(springs.structural.stiffness / springs.flexion.stiffness, 8.0, 1e-12);
  const SpringNetwork sheet = triangleNetwork(springs, U, triangleNodes(n, n), 1.0);
  const auto node = [](int row, int column) { return Eigen::Index{row} * n + column; };
  const Points x = atRest(sheet, node(middle, middle), node(middle, middle + 1),
                          1e-10 * springs.structural.preload);
  const auto change = [&](int i) {  // of the spring from column i on in the middle row
    return (x.col(node(middle, i + 1)) - x.col(node(middle, i))).norm() / U - 1.0;
  };
  const double ends[2] = {change(0), change(n - 2)}, seconds[2] = {change(1), change(n - 3)};
  EXPECT_NEAR(std::min(ends[0], ends[1]), -0.51, 0.005);
  EXPECT_NEAR(std::max(ends[0], ends[1]), -0.29, 0.005);
  EXPECT_NEAR(std::min(seconds[0], seconds[1]), -0.035, 0.0005);
  EXPECT_NEAR(std::max(seconds[0], seconds[1]), 0.052, 0.0005);
  for (int i = 2; i < n - 3; ++i) EXPECT_LT(std::abs(change(i)), 0.01) << i;
  // Across rows, at the middle column.
  for (int j = 0; j < n - 1; ++j) {
    const double rows = (x.col(node(j + 1, middle)) - x.col(node(j, middle))).norm() / U - 1.0;
    if (j == 0 || j == n - 2) {
      EXPECT_NEAR(rows, -0.34, 0.005) << j;
    } else {
      EXPECT_LT(std::abs(rows), 0.0013) << j;
    }
  }
  // Over all springs between masses three nodes inside, corners included.
  const auto inside = [](int i) {
    const int row = i / n, column = i % n;
    return row >= 3 && row <= n - 4 && column >= 3 && column <= n - 4;
  };
  double worst = 0.0;
  for (const Spring& s : sheet.springs) {
    if (!inside(s.a) || !inside(s.b) || s.kind != SpringKind::kStructural) continue;
    worst = std::max(worst, std::abs((x.col(s.b) - x.col(s.a)).norm() / s.length - 1.0));
  }
  EXPECT_NEAR(worst, 0.019, 0.0005);
}

// An endless strip of squares: of two rows that may move along x only, between which every diagonal
// counts twice. Preload that turns with the springs is left out of the closed form, h^2/U^2 of it.
TEST(SheetStatics, FreeEdgesOfSquaresContractInTheLastSpringOnly) {
  const double h = 0.1, U = 2.0;
  RectangleSprings springs = rectangleSprings({1.0e7, 0.3, h}, U);
  springs.shear.preload *= 2.0;
  springs.shear.stiffness *= 2.0;
  const SpringNetwork strip = rectangleNetwork(springs, U, rectangleNodes(17, 2), 1.0);
  NetworkLoads loads = noLoads(strip);
  loads.free.bottomRows<2>().setZero();
  loads.free.col(8).setZero();
  Points x = strip.points;
  ASSERT_EQ(solveNetwork(strip, loads, {1e-12 * springs.structural.preload}, &x).status,
            solver::SolveStatus::kConverged);
  const double expected = h * h / (6 * U * U + h * h);
  EXPECT_NEAR(expected, 4.2e-4, 0.05e-4);
  for (int i = 0; i < 16; ++i) {
    const double contraction = 1.0 - (x(0, i + 1) - x(0, i)) / U;
    EXPECT_NEAR(contraction, i == 0 || i == 15 ? expected : 0.0, 3 * h * h / (U * U) * expected)
        << i;
  }
}

// 32 x 24 x 0.1 cm, 16 x 12 squares. Its edges along x lack one diagonal in two, and so pull with
// -P2 each, which strains all of the sheet; that bounds what is left inside.
TEST(SheetStatics, AFreeSheetOfSquaresHardlyContracts) {
  const double E = 1.0e7, h = 0.1, U = 2.0;
  const RectangleSprings springs = rectangleSprings({E, 0.3, h}, U);
  const SpringNetwork sheet = rectangleNetwork(springs, U, rectangleNodes(17, 13), 1.0);
  const auto node = [](int row, int column) { return Eigen::Index{row} * 17 + column; };
  const Points x = atRest(sheet, node(6, 8), node(6, 9), 1e-9 * springs.structural.preload);
  const double expected = h * h / (6 * U * U + h * h);
  const double along = -2 * springs.flexion.preload / (0.952 * E * h * 12 * U);
  const double across = -2 * springs.flexion.preload / (0.952 * E * h * 16 * U);
  for (int i = 0; i < 16; ++i) {
    const double contraction = 1.0 - (x(0, node(6, i + 1)) - x(0, node(6, i))) / U;
    EXPECT_NEAR(contraction, i == 0 || i == 15 ? expected : 0.0, along) << i;
  }
  for (int j = 0; j < 12; ++j) {
    const double contraction = 1.0 - (x(1, node(j + 1, 8)) - x(1, node(j, 8))) / U;
    EXPECT_NEAR(contraction, j == 0 || j == 11 ? expected : 0.0, across) << j;
  }
}

TEST(SheetStatics, FreeEdgesOfTrianglesContractLess) {
  const double h = 0.1, U = 2.0;
  const TriangleSprings springs = triangleSprings({1.0e7, 0.3, h}, U);
  const SpringNetwork sheet = triangleNetwork(springs, U, triangleNodes(17, 15), 1.0);
  const auto node = [](int row, int column) { return Eigen::Index{row} * 17 + column; };
  const Points x = atRest(sheet, node(7, 8), node(7, 9), 1e-9 * springs.structural.preload);
  const double square = h * h / (6 * U * U + h * h);
  for (int i = 3; i < 13; ++i) {
    EXPECT_LT(std::abs((x.col(node(7, i + 1)) - x.col(node(7, i))).norm() / U - 1.0), 0.1 * square);
  }
}

// At rest in its plane a free sheet of triangles loses energy by no small motion. One of squares
// does: its edges are in tension, and press on what is inside.
TEST(SheetStatics, FreeTrianglesDoNotBuckleAndSquaresDo) {
  const Sheet sheet{1.0e7, 0.3, 0.1};
  const double U = 2.0;
  const auto modesAtRest = [](SpringNetwork network) {
    const Points x = atRest(network, 0, 1, 1e-6);
    for (Spring& s : network.springs) {
      const double u = (x.col(s.b) - x.col(s.a)).norm();
      s.preload = springForce(s, u);
      s.length = u;
    }
    network.points = x;
    return networkModes(network);
  };
  const NetworkModes triangles =
      modesAtRest(triangleNetwork(triangleSprings(sheet, U), U, triangleNodes(17, 13), 1.0));
  const NetworkModes squares =
      modesAtRest(rectangleNetwork(rectangleSprings(sheet, U), U, rectangleNodes(17, 13), 1.0));
  EXPECT_EQ(triangles.falling, 0);
  EXPECT_EQ(triangles.neutral, 6);
  EXPECT_GT(squares.falling, 0);
  EXPECT_EQ(squares.neutral, 6);
}

struct Disc {
  SpringNetwork network;
  NetworkLoads loads;
  Eigen::Index middle;
};

// Nodes within n spacings may move, across the sheet only; three rings beyond are held.
template <class MakeNetwork>
Disc clampedDisc(int n, const Eigen::Matrix2d& axes, const MakeNetwork& make) {
  std::vector<GridNode> nodes;
  const int reach = 2 * (n + 4);
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      if ((axes * Eigen::Vector2d(i, j)).norm() < n + 3.5) nodes.emplace_back(i, j);
    }
  }
  Disc disc{make(nodes), {}, -1};
  disc.loads = noLoads(disc.network);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const bool held = (axes * nodes[k].cast<double>()).norm() > n * (1.0 - 1e-9);
    disc.loads.free.col(i) = held ? Vec3(0, 0, 0) : Vec3(0, 0, 1);
    if (nodes[k] == GridNode(0, 0)) disc.middle = i;
  }
  disc.loads.forces(2, disc.middle) = 1.0;
  return disc;
}

double middleStiffness(const Disc& disc) {
  const auto moved = linearDisplacements(disc.network, disc.network.points, disc.loads,
                                         Points::Zero(3, disc.network.points.cols()));
  return moved ? 1.0 / (*moved)(2, disc.middle) : -1.0;
}

Eigen::Matrix2d triangleAxes() {
  Eigen::Matrix2d axes;
  axes << 1.0, 0.5, 0.0, 0.5 * std::sqrt(3.0);
  return axes;
}

double plate(const Sheet& sheet, double a) { return 16 * kPi * sheet.bendingStiffness() / (a * a); }

double triangleDisc(const Sheet& sheet, int n, double U) {
  return middleStiffness(clampedDisc(n, triangleAxes(),
                                     [&](const auto& nodes) {
                                       return triangleNetwork(triangleSprings(sheet, U), U, nodes,
                                                              1.0);
                                     })) /
         plate(sheet, n * U);
}

double squareDisc(const Sheet& sheet, int n, double U) {
  return middleStiffness(clampedDisc(n, Eigen::Matrix2d::Identity(),
                                     [&](const auto& nodes) {
                                       return rectangleNetwork(rectangleSprings(sheet, U), U, nodes,
                                                               1.0);
                                     })) /
         plate(sheet, n * U);
}

// Over 16 pi D/a^2, the stiffness of a clamped plate under a force in the middle (4.62).
TEST(SheetStatics, ClampedDiscsApproachThePlate) {
  const std::map<int, std::pair<double, double>> reference = {
      {1, {.269, .388}}, {2, {.438, .500}},  {4, {.632, .668}},
      {8, {.775, .810}}, {16, {.879, .888}}, {32, {.931, .931}}};
  const double a = 10.0;
  for (const auto& [n, ratios] : reference) {
    EXPECT_NEAR(triangleDisc({1.0e7, 0.3, 0.01}, n, a / n), ratios.first, 0.0005) << n;
    EXPECT_NEAR(squareDisc({1.0e7, 0.3, 0.01}, n, a / n), ratios.second, 0.0005) << n;
  }
  EXPECT_NEAR(triangleDisc({1.0e7, 1.0 / 3.0, 0.01}, 32, a / 32), 0.955, 0.0005);
  EXPECT_NEAR(squareDisc({1.0e7, 1.0 / 3.0, 0.01}, 32, a / 32), 0.955, 0.0005);
}

// (4.64): 6 sqrt(3) (1 + nu) D/U^2 of the smallest disc.
TEST(SheetStatics, SmallestDisc) {
  const Sheet sheet{1.0e7, 0.3, 0.01};
  const double U = 10.0;
  const double expected = 6 * std::sqrt(3.0) * 1.3 * sheet.bendingStiffness() / (U * U);
  EXPECT_NEAR(triangleDisc(sheet, 1, U) * plate(sheet, U), expected, 1e-9 * expected);
}

// Force on the middle at the deflection w, over that of the linear plate, where points inside may
// move in the plane as well and the held ones not at all.
double stiffening(Disc disc, const Sheet& sheet, double a, double w) {
  Points x = disc.network.points;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    if (disc.loads.free(2, i) != 0.0) disc.loads.free.col(i).setOnes();
    const double part = std::max(0.0, 1.0 - x.col(i).norm() / a);
    if (disc.loads.free(2, i) != 0.0) x(2, i) = w * part;
  }
  disc.loads.forces.setZero();
  disc.loads.free(2, disc.middle) = 0.0;
  const double linear = plate(sheet, a) * w;
  EXPECT_EQ(solveNetwork(disc.network, disc.loads, {1e-6 * linear}, &x).status,
            solver::SolveStatus::kConverged);
  return -networkForces(disc.network, x)(2, disc.middle) / linear;
}

// Beyond its thickness a clamped sheet stretches. Figures of another program on the same networks,
// n = 8, with the stiffnesses of chapter 5.
TEST(SheetStatics, ClampedDiscsStiffenAsTheyStretch) {
  const double a = 10.0, h = 0.01, U = a / 8;
  const Sheet sheet{1.0e7, 0.3, h};
  const Disc triangles = clampedDisc(8, triangleAxes(), [&](const auto& nodes) {
    return triangleNetwork(triangleSprings(sheet, U), U, nodes, 1.0);
  });
  const Disc squares = clampedDisc(8, Eigen::Matrix2d::Identity(), [&](const auto& nodes) {
    return rectangleNetwork(rectangleSprings(sheet, U), U, nodes, 1.0);
  });
  EXPECT_NEAR(stiffening(triangles, sheet, a, h), 1.09, 0.005);
  EXPECT_NEAR(stiffening(squares, sheet, a, h), 1.15, 0.005);
  EXPECT_NEAR(stiffening(triangles, sheet, a, 5 * h), 7.1, 0.05);
  EXPECT_NEAR(stiffening(squares, sheet, a, 5 * h), 7.4, 0.05);
}

TEST(SheetStatics, WithoutPreloadNothingResistsASmallDeflection) {
  const Sheet sheet{1.0e7, 0.3, 0.01};
  Disc disc = clampedDisc(8, triangleAxes(), [&](const auto& nodes) {
    return triangleNetwork(triangleSprings(sheet, 1.0), 1.0, nodes, 1.0);
  });
  for (Spring& s : disc.network.springs) s.preload = 0.0;
  const Eigen::SparseMatrix<double> K = networkTangent(disc.network, disc.network.points);
  Points w = Points::Zero(3, disc.network.points.cols());
  w.row(2).setRandom();
  const Eigen::VectorXd force = K * Eigen::Map<const Eigen::VectorXd>(w.data(), w.size());
  EXPECT_EQ(force.norm(), 0.0);
  EXPECT_EQ(middleStiffness(disc), -1.0);
}

}  // namespace
}  // namespace palpate::springs::sheet_statics_test
